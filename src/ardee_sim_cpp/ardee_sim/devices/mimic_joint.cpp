// SPDX-License-Identifier: MIT
#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

/// libroboticsgroup_gazebo_mimic_joint_plugin.so: a joint that follows another. The plugin sets the
/// follower's position; here a load on either joint acts on both.
class MimicJoint : public Device {
 public:
  MimicJoint(const std::string& name, const Coupling& coupling, Robot& robot)
      : Device(name), coupling_(coupling), robot_(robot) {
    reset(0);
  }

  void reset(TimeNs /*now_ns*/) override { robot_.dynamics().couple_joints(coupling_); }

 private:
  Coupling coupling_;
  Robot& robot_;
};

}  // namespace

std::unique_ptr<Device> make_mimic_joint(const PluginDescription& plugin, Parameters& parameters,
                                         DeviceContext& context) {
  plugin_namespace(parameters, context);
  const auto joint = [&](const char* key) {
    const std::string name = parameters.required_text(key);
    const std::size_t index = context.joint_index(name, parameters.block(key)->source);
    return context.robot.model().joints[index].name;
  };
  Coupling coupling;
  coupling.leader = joint("joint");
  coupling.follower = joint("mimicJoint");
  coupling.multiplier =
      parameters.number("multiplier", 1.0, -limits::kMostFactor, limits::kMostFactor);
  coupling.offset = parameters.number("offset", 0.0, -limits::kMostTravel, limits::kMostTravel);
  coupling.source = parameters.source();
  // Without a PID the plugin sets the position, with unlimited effort.
  const double max_effort = parameters.number("maxEffort", 1.0, 0.0);
  const bool has_pid = parameters.has("hasPID");
  parameters.text("hasPID", "");
  if (has_pid) coupling.max_effort = max_effort;
  if (parameters.number("sensitiveness", 0.0, 0.0) > 0.0) {
    context.log.warn(parameters.source(),
                     "found <sensitiveness>, expected none or 0: the joint follows exactly");
  }
  return std::make_unique<MimicJoint>(plugin.name, coupling, context.robot);
}

}  // namespace ardee::devices
