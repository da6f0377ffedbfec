// SPDX-License-Identifier: MIT
#include "simulation.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "ardee_sim/controllers/ros_control.h"
#include "ardee_sim/core/nearest_names.h"
#include "arrays.h"
#include "commands.h"
#include "descriptions.h"
#include "readings.h"
#include "unlocked.h"

namespace ardee::python {
namespace {

using devices::Input;
using devices::Output;
using devices::Service;

/// "cmd_vel" and "/cmd_vel" are one topic.
std::string whole(const std::string& topic) {
  return !topic.empty() && topic.front() == '/' ? topic : "/" + topic;
}

py::key_error unknown(const std::string& kind, const std::string& name,
                      std::vector<std::string> known) {
  std::sort(known.begin(), known.end());
  known.erase(std::unique(known.begin(), known.end()), known.end());
  return py::key_error("found no " + kind + " '" + name +
                       "', expected one of: " + nearest_names(name, known));
}

py::tuple made(const Inbox::Item& item) {
  return py::make_tuple(reading_class(item->index()), reading_fields(item));
}

/// Calls act(ports) for the ports of each device, and of each controller that it has loaded.
template <typename Act>
void visit_ports(const Entity& entity, Act act) {
  for (const auto& device : entity.devices) {
    act(device->ports());
    auto* control = dynamic_cast<control::RosControl*>(device.get());
    if (control == nullptr) continue;
    for (const control::ControllerState& each : control->manager().list()) {
      act(control->manager().find(each.name)->ports());
    }
  }
}

}  // namespace

BoundSimulation::BoundSimulation(std::shared_ptr<LoadedWorld> world, std::uint64_t seed,
                                 int ray_threads)
    : world_(std::move(world)), seed_(seed), log_(world_->log()) {
  SimulationOptions options;
  options.seed = seed;
  options.rays.threads = ray_threads;
  options.locator = world_->locator();
  options.parameter = [this](const std::string& name) {
    return parameters_.at(whole(name).substr(1));
  };
  simulation_ = std::make_unique<Simulation>(world_->world(), options,
                                             [this](LogLevel level, const std::string& text) {
                                               log_.push_back({level, text});
                                               if (level == LogLevel::kError) fault_ = text;
                                             });
  simulation_->set_sink(&inbox_);
  apply_demands();
}

BoundSimulation::Use::Use(BoundSimulation& bound) : bound_(bound) {
  if (bound.in_use_.exchange(true)) {
    throw std::runtime_error(
        "found a simulation that another thread is using, expected an idle one");
  }
  if (!bound.simulation_) {
    bound.in_use_ = false;
    throw std::runtime_error("found a simulation that is closed, expected an open one");
  }
}

void BoundSimulation::close() {
  if (!simulation_) return;
  const Use use(*this);
  simulation_.reset();
}

void BoundSimulation::spawn(const Spawn& wanted) {
  const Use use(*this);
  log_.insert(log_.end(), wanted.model->log.begin(), wanted.model->log.end());
  SpawnRequest request;
  request.name = wanted.name;
  request.model = wanted.model->model;
  request.X_WM = wanted.X_WM;
  request.robot_namespace = wanted.robot_namespace;
  request.joint_positions = wanted.joint_positions;
  request.is_static = wanted.is_static;
  request.scale = wanted.scale;
  request.label = wanted.label;
  for (const auto& device : use->spawn(request).devices) {
    if (dynamic_cast<const control::RosControl*>(device.get()) == nullptr) continue;
    log_.push_back({LogLevel::kInfo, "model '" + wanted.name +
                                         "': its controllers of ros_control are started by "
                                         "start_controllers()"});
  }
  spawned_[wanted.name] = wanted.model;
  apply_demands();
}

void BoundSimulation::remove(const std::string& name) {
  const Use use(*this);
  if (use->find(name) == nullptr) throw Error("found no model '" + name + "' to remove");
  use->remove(name);
  spawned_.erase(name);
}

void BoundSimulation::step(std::uint64_t count) {
  const Use use(*this);
  constexpr std::chrono::milliseconds kSignals{50};
  const Unlocked unlocked;
  auto look_at = std::chrono::steady_clock::now() + kSignals;
  fault_.reset();
  for (std::uint64_t i = 0; i < count && !Unlocked::has_to_return(); ++i) {
    if (wants_contacts_) use->want_contacts();
    use->step();
    for (const physics::Contact& each : use->contacts()) {
      touches_.emplace(each.collision1, each.collision2);
    }
    if (fault_) throw PhysicsFault(*fault_);
    if (std::chrono::steady_clock::now() < look_at) continue;
    const py::gil_scoped_acquire held;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    look_at = std::chrono::steady_clock::now() + kSignals;
  }
}

void BoundSimulation::reset() {
  const Use use(*this);
  use->reset_simulation();
  inbox_.clear();
  touches_.clear();
}

void BoundSimulation::set_noise_seed(std::uint64_t seed) {
  const Use use(*this);
  use->set_noise_seed(seed);
  inbox_.clear();
}

void BoundSimulation::set_daylight(double azimuth_deg, double elevation_deg, double turbidity,
                                   double cloud) {
  const Use use(*this);
  use->set_daylight({azimuth_deg, elevation_deg, turbidity, cloud});
}

RelativeState BoundSimulation::state(const std::string& name, const std::string& reference) {
  return Use(*this)->state(name, reference);
}

void BoundSimulation::set_state(const std::string& model, const RelativeState& state,
                                const std::string& reference) {
  Use(*this)->set_state(model, state, reference);
}

template <typename Kind, typename Act>
std::vector<std::string> BoundSimulation::for_each(const Simulation& simulation, Act act) const {
  std::vector<std::string> names;
  for (const auto& entity : simulation.entities()) {
    visit_ports(*entity, [&](devices::Ports& ports) {
      for (Kind& port : ports.all<Kind>()) {
        if constexpr (std::is_same_v<Kind, Service>) {
          names.push_back(port.name);
        } else {
          names.push_back(port.topic);
        }
        act(port);
      }
    });
  }
  return names;
}

void BoundSimulation::apply_demands() {
  for_each<Output>(*simulation_,
                   [this](Output& output) { output.demanded = inbox_.demands(output.topic); });
}

Output& BoundSimulation::output(const Simulation& simulation, const std::string& topic) const {
  Output* found = nullptr;
  const auto known = for_each<Output>(simulation, [&](Output& output) {
    if (output.topic == whole(topic)) found = &output;
  });
  if (found == nullptr) throw unknown("topic with readings", topic, known);
  return *found;
}

void BoundSimulation::command(const std::string& topic, const py::object& value) {
  const Use use(*this);
  bool is_taken = false;
  const auto known = for_each<Input>(*use, [&](Input& input) {
    if (input.topic != whole(topic)) return;
    input.on_command(to_command(input.kind, value));
    is_taken = true;
  });
  if (!is_taken) throw unknown("topic with commands", topic, known);
}

py::object BoundSimulation::call(const std::string& service, const py::args& arguments) {
  const Use use(*this);
  Service* found = nullptr;
  const auto known = for_each<Service>(*use, [&](Service& each) {
    if (each.name == whole(service)) found = &each;
  });
  if (found == nullptr) throw unknown("service", service, known);
  return python::call(*found, arguments);
}

void BoundSimulation::demand(const std::string& topic, std::size_t keep) {
  const Use use(*this);
  output(*use, topic);
  inbox_.demand(whole(topic), keep);
  apply_demands();
}

void BoundSimulation::undemand(const std::string& topic) {
  const Use use(*this);
  output(*use, topic);
  if (!inbox_.knows(whole(topic))) return;
  inbox_.undemand(whole(topic));
  apply_demands();
}

bool BoundSimulation::demands(const std::string& topic) {
  const Use use(*this);
  output(*use, topic);
  return inbox_.demands(whole(topic));
}

py::object BoundSimulation::latest(const std::string& topic) {
  const Use use(*this);
  if (!inbox_.knows(whole(topic))) {
    output(*use, topic);
    throw Error("found the topic '" + topic + "', which was not demanded: sim.demand('" + topic +
                "') first");
  }
  const Inbox::Item item = inbox_.latest(whole(topic));
  return item ? py::object(made(item)) : py::none();
}

py::list BoundSimulation::drain(const std::string& topic) {
  const Use use(*this);
  if (!inbox_.knows(whole(topic))) output(*use, topic);
  py::list items;
  if (!inbox_.knows(whole(topic))) return items;
  for (const Inbox::Item& item : inbox_.drain(whole(topic))) items.append(made(item));
  return items;
}

std::size_t BoundSimulation::dropped(const std::string& topic) {
  const Use use(*this);
  output(*use, topic);
  return inbox_.knows(whole(topic)) ? inbox_.dropped(whole(topic)) : 0;
}

py::list BoundSimulation::contacts() {
  const Use use(*this);
  py::list found;
  for (const physics::Contact& contact : use->contacts()) found.append(contact_fields(contact));
  return found;
}

py::list BoundSimulation::take_touches() {
  const Use use(*this);
  py::list found;
  for (const auto& [one, other] : touches_) found.append(py::make_tuple(one, other));
  touches_.clear();
  return found;
}

py::object BoundSimulation::description(const std::string& name) {
  const Use use(*this);
  const Entity* found = use->find(name);
  if (found == nullptr) throw Error("found no model '" + name + "'");
  return to_python(found->instance.model);
}

py::list BoundSimulation::scenery(double x_m, double y_m, double radius_m) {
  const Use use(*this);
  std::map<std::shared_ptr<const Model>, std::vector<double>> near;
  std::vector<std::shared_ptr<const Model>> order;
  for (const auto& entity : use->entities()) {
    const bool is_field = entity->placements.size() > 1;
    for (const Placement& each : entity->placements) {
      const Eigen::Vector3d& p = each.X_WM.p;
      if (is_field && std::hypot(p.x() - x_m, p.y() - y_m) > radius_m) continue;
      const auto [rows, is_new] = near.try_emplace(each.model);
      if (is_new) order.push_back(each.model);
      rows->second.insert(rows->second.end(), p.data(), p.data() + 3);
      const Eigen::Vector4d q = each.X_WM.q.coeffs();
      rows->second.insert(rows->second.end(), q.data(), q.data() + 4);
      rows->second.push_back(each.scale);
    }
  }
  py::list found;
  for (const auto& model : order) {
    std::vector<double>& rows = near.at(model);
    const auto count = static_cast<py::ssize_t>(rows.size() / 8);
    found.append(py::make_tuple(to_python(model), hold(std::move(rows), {count, 8})));
  }
  return found;
}

py::list BoundSimulation::entities() {
  const Use use(*this);
  py::list found;
  for (const auto& entity : use->entities()) {
    const Model& model = entity->robot->model();
    py::list joints, links, topics;
    for (const Joint& joint : model.joints) joints.append(joint.name);
    for (const Link& link : model.links) links.append(link.name);
    visit_ports(*entity, [&topics](devices::Ports& ports) {
      for (Output& output : ports.all<Output>()) topics.append(output.topic);
      for (Input& input : ports.all<Input>()) topics.append(input.topic);
    });
    found.append(py::make_tuple(entity->name(), py::tuple(joints), py::tuple(links),
                                py::tuple(topics), entity->is_static()));
  }
  return found;
}

py::list BoundSimulation::topics() {
  const Use use(*this);
  const double steps_hz = 1.0 / use->physics().step_s;
  py::list found;
  for_each<Output>(*use, [&](const Output& each) {
    std::optional<double> rate_hz = each.rate_hz;
    if (rate_hz) rate_hz = *rate_hz > 0.0 ? std::min(*rate_hz, steps_hz) : steps_hz;
    found.append(
        py::make_tuple(each.topic, reading_class(each.kind), "reading", rate_hz, each.frame_id));
  });
  for_each<Input>(*use, [&](const Input& each) {
    found.append(py::make_tuple(each.topic, command_name(each.kind), "command", py::none(), ""));
  });
  for_each<Service>(*use, [&](const Service& each) {
    found.append(py::make_tuple(each.name, "service", "service", py::none(), ""));
  });
  return found;
}

std::vector<LogLine> BoundSimulation::take_log() {
  const Use use(*this);
  return std::exchange(log_, {});
}

std::int64_t BoundSimulation::time_ns() { return Use(*this)->now_ns(); }
std::uint64_t BoundSimulation::step_count() { return Use(*this)->step_count(); }
std::int64_t BoundSimulation::step_ns() { return nanoseconds(Use(*this)->physics().step_s); }
Eigen::Vector3d BoundSimulation::gravity_m_s2() { return Use(*this)->physics().gravity_m_per_s2; }

}  // namespace ardee::python
