// SPDX-License-Identifier: MIT
#include "ros/robot_topics.h"

#include <algorithm>
#include <set>
#include <utility>

#include "ardee_sim/core/error.h"
#include "ardee_sim/devices/sensor.h"
#include "ros/reading_to_message.h"

namespace ardee::node {
namespace {

/// Odometry is always measured: OdometryFrames reads it.
bool always_demanded(const devices::Output& output) {
  return output.kind == devices::reading_kind<devices::OdometryReading>() ||
         output.kind == devices::reading_kind<devices::TransformReading>();
}

/// "model::link::sensor", or empty for a device that is not a sensor.
std::string sensor_name(const devices::Device& device, const devices::Robot& robot) {
  const auto* sensor = dynamic_cast<const devices::Sensor*>(&device);
  if (!sensor) return "";
  return robot.name() + "::" + robot.model().links[sensor->link()].name + "::" + device.name();
}

void append(const std::vector<std::string>& more, std::vector<std::string>& all) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

void RobotTopics::add(devices::Device& device, const devices::Robot& robot, Topics& topics) {
  topics.devices.push_back(std::make_unique<PortTopics>(node_, device.ports(), robot,
                                                        sensor_name(device, robot), routes_));
  append(topics.devices.back()->taken(), topics.taken);
  if (auto* control = dynamic_cast<control::RosControl*>(&device)) {
    topics.managers.push_back(
        std::make_unique<ControllerServices>(node_, *control, robot, routes_, log_));
    append(topics.managers.back()->taken(), topics.taken);
  }
}

void RobotTopics::add(Entity& entity) {
  Topics topics;
  std::set<const devices::Device*> left_out;
  for (const auto& device : entity.devices) {
    try {
      add(*device, *entity.robot, topics);
    } catch (const Error& error) {
      const Error placed(entity.robot->model().source,
                         "plugin '" + device->name() + "': " + error.what());
      if (!device->is_optional()) throw placed;
      log_.error(std::string(placed.what()) + "; it is left out");
      left_out.insert(device.get());
    }
  }
  auto& devices = entity.devices;
  devices.erase(std::remove_if(devices.begin(), devices.end(),
                               [&](const auto& device) { return left_out.count(device.get()); }),
                devices.end());
  warn_of_taken(topics.taken, *entity.robot, log_);
  topics_[entity.name()] = std::move(topics);
}

void RobotTopics::remove(const std::string& entity_name) {
  if (topics_.erase(entity_name) > 0) frames_.forget(entity_name);
}

void RobotTopics::update_demand() {
  for (const auto& [output, route] : routes_) {
    route.output->demanded = always_demanded(*output) || output->latched || route.has_listeners();
  }
}

void RobotTopics::count(const Route& route, TimeNs now_ns) {
  if (route.sensor.empty() || !metrics_.has_listeners()) return;
  metrics_.on_measured(route.sensor, route.is_camera, now_ns);
}

void RobotTopics::on_reading(const devices::Output& output, const devices::Reading& reading) {
  const auto found = routes_.find(&output);
  if (found == routes_.end()) return;
  const Route& route = found->second;
  std::visit(
      [&](const auto& measured) {
        frames_.on_reading(*route.robot, measured);
        count(route, measured.header.stamp_ns);
        if (!output.latched && !route.has_listeners()) return;
        if (route.publisher) {
          route.publisher.publish(to_message(measured));
        } else if constexpr (std::is_same_v<std::decay_t<decltype(measured)>,
                                            devices::ImageReading>) {
          route.pictures->send(boost::make_shared<sensor_msgs::Image>(to_message(measured)));
        }
      },
      reading);
}

}  // namespace ardee::node
