// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/inertial_sensor.h"
#include "ardee_sim/devices/sdf_imu_noise.h"

namespace ardee::devices {

/// libgazebo_ros_imu.so, a model plugin, and libgazebo_ros_imu_sensor.so, in a <sensor type="imu">.
/// The acceleration of the first excludes gravity (0 at rest) unless <gravity> is true; that of the
/// second includes gravity and the errors of its <imu> block. Both add white noise of
/// <gaussianNoise>. <xyzOffset> and <rpyOffset> are the mounting in the body. Unlike the stock ones
/// they rotate the right way, find bodies in their own robot only, and keep orientations of unit
/// length.
class GazeboImu : public InertialSensor {
 public:
  struct Params {
    Mount mount;
    SdfImuNoise noise{};
    double gaussian_noise = 0.0;     // rad/s and m/s^2, as in the stock plugins
    bool noisy_orientation = false;  // gaussian_noise on the quaternion's components too
    bool feels_gravity = true;
    bool initial_orientation_is_reference = false;
    std::string topic{};
    std::string frame{};
    std::string service{};  // it answers and does nothing: white noise has no bias; empty: none
  };

  static std::unique_ptr<Device> make_on_model(const PluginDescription& plugin,
                                               Parameters& parameters, DeviceContext& context);
  static std::unique_ptr<Device> make_on_sensor(const SensorDescription& sensor,
                                                Parameters& parameters, std::size_t link,
                                                DeviceContext& context);
  GazeboImu(const std::string& name, const Params& params,
            std::function<Eigen::Vector3d()> gravity_m_per_s2);

  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    InertialSensor::serialize(state);
    state(accel_, rate_, q_RW_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  Params params_;
  SensorModel accel_;
  SensorModel rate_;
  Eigen::Quaterniond q_RW_ = Eigen::Quaterniond::Identity();  // world in the reference
  Output& output_;
};

}  // namespace ardee::devices
