// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// libardee_ros_joint_position.so: a servo that holds a joint at the position commanded on a topic
/// (std_msgs/Float64, rad or m), as effort_controllers/JointPositionController does below
/// gazebo_ros_control. It limits its speed and acceleration: from rest to rest over a distance s it
/// takes s / v + v / a, or 2 sqrt(s / a) if it does not reach v. Commands beyond the joint's limits
/// lead to the limit.
class JointPosition : public Device {
 public:
  struct Params {
    std::size_t joint = 0;
    std::string topic;
    double lower = 0.0;  // rad or m
    double upper = 0.0;
    double max_velocity = 0.0;      // rad/s or m/s
    double max_acceleration = 0.0;  // rad/s^2 or m/s^2
    double max_effort = 0.0;        // N m or N
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  JointPosition(const std::string& name, const Params& params, Robot& robot);

  void before_step(TimeNs now_ns) override;
  /// Holds the joint at its present position.
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override { state(goal_, setpoint_, velocity_, last_ns_); }

 private:
  void move_setpoint(double dt_s);

  Params params_;
  Robot& robot_;
  double goal_ = 0.0;
  double setpoint_ = 0.0;  // on the way to the goal
  double velocity_ = 0.0;  // of the setpoint
  TimeNs last_ns_ = 0;
};

}  // namespace ardee::devices
