// SPDX-License-Identifier: MIT
#include <string>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

/// libgazebo_ros_force.so: pushes a link at its centre of mass with the last wrench received on a
/// topic, in the world's axes, at each step until the next one.
class LinkPush : public Device {
 public:
  LinkPush(const std::string& name, const std::string& topic, std::size_t link, Robot& robot)
      : Device(name), robot_(robot), link_(link) {
    ports().add_wrench_input(topic,
                             [this](const physics::ForceTorque& wrench) { wrench_ = wrench; });
  }

  void before_step(TimeNs /*now_ns*/) override {
    if (wrench_.force.isZero(0.0) && wrench_.torque.isZero(0.0)) return;
    physics::PhysicsModel& dynamics = robot_.dynamics();
    const auto& inertial = dynamics.link_properties(link_).inertial;
    const Eigen::Vector3d center_L = inertial ? inertial->X_LI.p : Eigen::Vector3d(0, 0, 0);
    dynamics.apply_wrench(link_, wrench_.force, robot_.link_pose(link_) * center_L, wrench_.torque);
  }
  void reset(TimeNs /*now_ns*/) override { wrench_ = {}; }
  void serialize(StateArchive& state) override { state(wrench_); }

 private:
  Robot& robot_;
  std::size_t link_;
  physics::ForceTorque wrench_;
};

}  // namespace

std::unique_ptr<Device> make_link_push(const PluginDescription& plugin, Parameters& parameters,
                                       DeviceContext& context) {
  context.robot.dynamics();  // a static model cannot be pushed
  const std::string space = plugin_namespace(parameters, context);
  const std::string body = parameters.required_text("bodyName");
  const std::size_t link = context.link_index(body, parameters.block("bodyName")->source);
  const std::string topic = resolve_topic(parameters.required_text("topicName"), space);
  parameters.ignore({"alwaysOn", "updateRate"});
  return std::make_unique<LinkPush>(plugin.name, topic, link, context.robot);
}

}  // namespace ardee::devices
