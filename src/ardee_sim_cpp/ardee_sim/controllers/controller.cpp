// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/controller.h"

#include "ardee_sim/core/error.h"
#include "ardee_sim/devices/names.h"

namespace ardee::control {

std::string interface_name(JointInterface interface) {
  switch (interface) {
    case JointInterface::kPosition:
      return "hardware_interface::PositionJointInterface";
    case JointInterface::kVelocity:
      return "hardware_interface::VelocityJointInterface";
    case JointInterface::kEffort:
      return "hardware_interface::EffortJointInterface";
  }
  return "";
}

std::string ControllerContext::own_name() const {
  return devices::resolve_topic(name, robot_namespace);
}

std::string ControllerContext::topic(const std::string& relative_topic) const {
  return devices::resolve_topic(name + "/" + relative_topic, robot_namespace);
}

JointHandle& ControllerContext::joint(const std::string& joint_name, JointInterface interface,
                                      const Setting& source) const {
  const auto found = hardware.find(joint_name);
  if (found == hardware.end()) {
    throw Error(source.path() + ": found joint '" + joint_name +
                "', expected one that a transmission names");
  }
  if (found->second.interface != interface) {
    throw Error(source.path() + ": joint '" + joint_name + "' has the " +
                interface_name(found->second.interface) + ", expected the " +
                interface_name(interface));
  }
  return found->second;
}

JointHandle& Controller::claim(const ControllerContext& context, const std::string& joint_name,
                               JointInterface interface, const Setting& source) {
  JointHandle& joint = context.joint(joint_name, interface, source);
  claims_[interface].insert(joint_name);
  return joint;
}

bool PublishTimer::due(TimeNs now_ns) {
  if (rate_hz_ <= 0.0) return false;
  const TimeNs period_ns = nanoseconds(1.0 / rate_hz_);
  if (last_ns_ + period_ns >= now_ns) return false;
  last_ns_ += period_ns;
  return true;
}

}  // namespace ardee::control
