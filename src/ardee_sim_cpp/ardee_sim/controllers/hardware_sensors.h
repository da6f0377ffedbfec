// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/inertial_motion.h"

namespace ardee::control {

/// An inertial sensor as controllers see it (hardware_interface::ImuSensorInterface): ideal, mean
/// over the last control period, in its own axes.
struct ImuHandle {
  std::string frame;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity{0, 0, 0};     // rad/s
  Eigen::Vector3d linear_acceleration{0, 0, 0};  // m/s^2; 9.8 upwards at rest
};

/// Wrench of a joint's child on the joint, about its origin, in the child's axes
/// (hardware_interface::ForceTorqueSensorInterface).
struct ForceTorqueHandle {
  std::string frame;
  physics::ForceTorque wrench;  // N, N m
  bool is_wanted = false;       // otherwise the wrench stays 0
};

struct SensorHandles {
  std::map<std::string, ImuHandle> imus;                   // by the sensor's name
  std::map<std::string, ForceTorqueHandle> force_torques;  // by the joint's name
};

/// Measures for the sensor controllers: at each `<sensor type="imu">` of a robot, and at each joint
/// that moves or has `<provide_feedback>`.
class HardwareSensors {
 public:
  explicit HardwareSensors(devices::DeviceContext& context);

  SensorHandles& handles() { return handles_; }
  void reset(TimeNs now_ns);
  void serialize(StateArchive& state);
  void on_set_state();
  void begin_step(TimeNs now_ns);
  void end_step(TimeNs now_ns);
  /// Brings the handles up to date.
  void read();

 private:
  struct Imu {
    ImuHandle* handle;
    std::size_t link;
    Pose X_LS;
    devices::InertialMotion motion;
  };
  struct JointWrench {
    ForceTorqueHandle* handle;
    std::size_t joint;
    std::size_t child;
  };

  devices::Robot& robot_;
  std::function<Eigen::Vector3d()> gravity_m_per_s2_;
  SensorHandles handles_;
  std::vector<Imu> imus_;
  std::vector<JointWrench> wrenches_;
};

}  // namespace ardee::control
