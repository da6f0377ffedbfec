// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/handles.h"

#include "ardee_sim/core/nearest_names.h"
#include "ardee_sim/simulation/simulation.h"

namespace ardee {
namespace {

/// "cmd_vel" and "/cmd_vel" are one topic.
std::string whole(const std::string& topic) {
  return !topic.empty() && topic.front() == '/' ? topic : "/" + topic;
}

/// Calls `found(port)` for each port (Input, Output) of that kind of all devices. Returns their
/// topics.
template <typename PortType, typename Found>
std::vector<std::string> for_each_port(const std::vector<std::unique_ptr<Entity>>& entities,
                                       std::size_t kind, Found found) {
  std::vector<std::string> topics;
  for (const auto& entity : entities) {
    for (const auto& device : entity->devices) {
      for (PortType& port : device->ports().all<PortType>()) {
        if (port.kind != kind) continue;
        topics.push_back(port.topic);
        found(port);
      }
    }
  }
  return topics;
}

}  // namespace

std::shared_ptr<const LatestReadings::Latest> LatestReadings::keep(const std::string& topic,
                                                                   std::size_t kind) {
  Kept& kept = kept_[topic];
  auto latest = kept.latest.lock();
  if (latest == nullptr || kept.kind != kind) {
    latest = std::make_shared<Latest>();
    kept = {kind, latest};
  }
  return latest;
}

void LatestReadings::clear() {
  for (auto& [topic, kept] : kept_) {
    if (const auto latest = kept.latest.lock()) latest->reset();
  }
}

LatestReadings::Saved LatestReadings::save() const {
  Saved saved;
  for (const auto& [topic, kept] : kept_) {
    const auto latest = kept.latest.lock();
    if (latest && *latest) saved.emplace(topic, **latest);
  }
  return saved;
}

void LatestReadings::restore(const Saved& saved) {
  clear();
  for (const auto& [topic, reading] : saved) {
    const auto found = kept_.find(topic);
    if (found == kept_.end() || found->second.kind != reading.index()) continue;
    if (const auto latest = found->second.latest.lock()) *latest = reading;
  }
}

bool LatestReadings::wants(const devices::Output& output) const {
  const auto found = kept_.find(output.topic);
  return next_ != nullptr || (found != kept_.end() && found->second.kind == output.kind &&
                              !found->second.latest.expired());
}

void LatestReadings::on_reading(const devices::Output& output, const devices::Reading& reading) {
  const auto found = kept_.find(output.topic);
  if (found != kept_.end() && found->second.kind == reading.index()) {
    if (const auto latest = found->second.latest.lock()) {
      *latest = reading;
    } else {
      kept_.erase(found);
    }
  }
  if (next_ != nullptr) next_->on_reading(output, reading);
}

void Simulation::demand_readings(Entity& entity) {
  for (const auto& device : entity.devices) {
    for (devices::Output& output : device->ports().all<devices::Output>()) {
      output.demanded = latest_.wants(output);
    }
  }
}

void Simulation::set_sink(devices::ReadingSink* sink) {
  latest_.hand_on_to(sink);
  for (const auto& entity : entities_) demand_readings(*entity);
}

devices::Input& Simulation::input(const std::string& topic, std::size_t kind) const {
  devices::Input* found = nullptr;
  const std::vector<std::string> known =
      for_each_port<devices::Input>(entities_, kind, [&](devices::Input& input) {
        if (input.topic == whole(topic)) found = &input;
      });
  if (found == nullptr) {
    throw Error(
        "found no topic '" + whole(topic) +
        "' that takes such commands, expected one of: " + nearest_names(whole(topic), known));
  }
  return *found;
}

std::shared_ptr<const LatestReadings::Latest> Simulation::keep_latest(const std::string& topic,
                                                                      std::size_t kind) {
  bool found = false;
  const std::vector<std::string> known =
      for_each_port<devices::Output>(entities_, kind, [&](devices::Output& output) {
        if (output.topic != whole(topic)) return;
        output.demanded = true;
        found = true;
      });
  if (!found) {
    throw Error(
        "found no topic '" + whole(topic) +
        "' that gives such readings, expected one of: " + nearest_names(whole(topic), known));
  }
  return latest_.keep(whole(topic), kind);
}

}  // namespace ardee
