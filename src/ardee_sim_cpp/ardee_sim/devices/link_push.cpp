// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/link_push.h"

#include "ardee_sim/devices/names.h"

namespace ardee::devices {

std::unique_ptr<Device> LinkPush::make(const PluginDescription& plugin, Parameters& parameters,
                                       DeviceContext& context) {
  context.robot.dynamics();  // a static model cannot be pushed
  const std::string space = plugin_namespace(parameters, context);
  const std::string body = parameters.required_text("bodyName");
  const std::size_t link = context.link_index(body, parameters.block("bodyName")->source);
  const std::string topic = resolve_topic(parameters.required_text("topicName"), space);
  parameters.ignore({"alwaysOn", "updateRate"});
  return std::make_unique<LinkPush>(plugin.name, topic, link, context.robot);
}

LinkPush::LinkPush(const std::string& name, const std::string& topic, std::size_t link,
                   Robot& robot)
    : Device(name), robot_(robot), link_(link) {
  ports().add_wrench_input(topic, [this](const physics::ForceTorque& wrench) { wrench_ = wrench; });
}

void LinkPush::before_step(TimeNs /*now_ns*/) {
  if (wrench_.force.isZero(0.0) && wrench_.torque.isZero(0.0)) return;
  physics::PhysicsModel& dynamics = robot_.dynamics();
  const auto& inertial = dynamics.link_properties(link_).inertial;
  const Eigen::Vector3d center_L = inertial ? inertial->X_LI.p : Eigen::Vector3d(0, 0, 0);
  dynamics.apply_wrench(link_, wrench_.force, robot_.link_pose(link_) * center_L, wrench_.torque);
}

void LinkPush::reset(TimeNs /*now_ns*/) { wrench_ = {}; }

}  // namespace ardee::devices
