// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/sensor.h"
#include "ardee_sim/devices/sensor_model.h"

namespace ardee::devices {

/// libhector_gazebo_ros_magnetic.so: the Earth's field in the body's axes, in the unit of
/// <magnitude>, as Vector3Stamped or, with <useMagneticFieldMsgs>, as MagneticField.
class Magnetometer : public Sensor {
 public:
  struct Params {
    Mount mount;
    Eigen::Vector3d field_W{0, 0, 0};
    SensorErrors errors{};
    bool as_magnetic_field = false;
    std::string topic{};
    std::string frame{};
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  Magnetometer(const std::string& name, const Params& params);

  /// Angles in rad: heading of x and declination clockwise from north, inclination downwards.
  static Eigen::Vector3d field_in_world(double magnitude, double heading_rad,
                                        double declination_rad, double inclination_rad);

  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(model_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return true; }

 private:
  Params params_;
  SensorModel model_;
  Output& output_;
};

}  // namespace ardee::devices
