// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ardee_sim/devices/inertial_sensor.h"
#include "ardee_sim/devices/sensor_model.h"
#include "ardee_sim/devices/vibration.h"

namespace ardee::devices {

/// libhector_gazebo_ros_imu.so: specific force, angular velocity and the orientation of an attitude
/// filter that trusts its biased sensors, each with hector's errors (<accel...>, <rate...>,
/// <yaw...>). <xyzOffset> and <rpyOffset> are the mounting in the body (hector reads the first but
/// does not apply it, and applies the second in the world). <vibrationStdAccel> adds vibration in
/// proportion to the robot's speed over ground.
class HectorImu : public InertialSensor {
 public:
  struct Params {
    Mount mount;
    SensorErrors accel{};
    SensorErrors rate{};
    SensorErrors yaw{};
    std::optional<VibrationParams> vibration{};
    std::string topic{};
    std::string bias_topic{};
    std::string calibrate_service{};
    std::string frame{};
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  HectorImu(const std::string& name, const Params& params,
            std::function<Eigen::Vector3d()> gravity_m_per_s2);

  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    InertialSensor::serialize(state);
    state(accel_, rate_, yaw_, vibration_, mean_vibration_, shaken_s_, followed_ns_);
  }

 protected:
  void follow(TimeNs now_ns) override;
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  Eigen::Quaterniond orientation_error(const Eigen::Quaterniond& q_WS) const;
  void shake(double dt_s);
  /// Mean vibration since the last call.
  Eigen::Vector3d take_vibration();
  void set_covariances(ImuReading& reading) const;

  SensorModel accel_;
  SensorModel rate_;
  SensorModel yaw_;
  std::optional<Vibration> vibration_;
  Eigen::Vector3d mean_vibration_{0, 0, 0};  // over the last shaken_s_
  double shaken_s_ = 0.0;
  TimeNs followed_ns_ = 0;
  std::string frame_;
  Output& output_;
  Output& bias_output_;
};

}  // namespace ardee::devices
