// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/ray_sensor.h"
#include "ardee_sim/devices/sensor_model.h"

namespace ardee::devices {

/// A sonar or infrared ranger: the nearest range of all rays over its cone. Without a return it
/// reports its maximum; a range below its minimum is reported as the minimum.
class RangeFinder : public RaySensor {
 public:
  struct Params {
    RaySensor::Params ray;
    RangeReading::Radiation radiation = RangeReading::Radiation::kUltrasound;
    double field_of_view_rad = 0.0;  // as reported
    SensorErrors errors;             // of a range below the maximum, m
    bool is_tunable = false;         // the errors can be changed while it runs
  };

  /// libgazebo_ros_range.so
  static std::unique_ptr<Device> make_range(const SensorDescription& sensor, Parameters& keys,
                                            std::size_t link, DeviceContext& context);
  /// libhector_gazebo_ros_sonar.so
  static std::unique_ptr<Device> make_sonar(const SensorDescription& sensor, Parameters& keys,
                                            std::size_t link, DeviceContext& context);
  RangeFinder(const std::string& name, const Mount& mount, const Params& params,
              RaySceneProvider& scenes);

  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(model_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  /// Always true: its errors move on without subscribers; rays are cast only for subscribers.
  bool wanted() const override { return true; }

 private:
  /// Range by REP 117: +inf no return, -inf nearer than the minimum.
  double nearest_m(const CounterRng& noise);

  Params params_;
  SensorModel model_;
};

}  // namespace ardee::devices
