// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/gps_params.h"

namespace ardee::devices {

/// libhector_gazebo_ros_gps.so: position and velocity (north, west, up) with hector's errors.
class Gps : public Sensor {
 public:
  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  Gps(const std::string& name, const GpsParams& params);

  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(frame_on_earth_, position_, velocity_, status_, service_);
  }

 protected:
  /// Reception at one time.
  struct Sky {
    double offset_factor = 1.0;              // of the position's offset
    double variance_factor = 1.0;            // of the variance of the position's noise and drift
    Eigen::Vector3d extra_error_m{0, 0, 0};  // in the world's axes
    double extra_std_m = 0.0;                // standard deviation of extra_error_m
    bool has_fix = true;
  };
  /// Reception of an antenna at a place in the world.
  virtual Sky sky(const Eigen::Vector3d& position_W, TimeNs now_ns);
  /// Reports the resulting error in the world's axes and its standard deviation by axis.
  virtual void report(TimeNs /*now_ns*/, const Sky& /*sky*/, const Eigen::Vector3d& /*error_W*/,
                      const Eigen::Vector3d& /*std_m*/, ReadingSink& /*sink*/) {}

  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  /// Always true: errors drift on without subscribers.
  bool wanted() const override { return true; }
  const LocalFrame& frame_on_earth() const { return frame_on_earth_; }

 private:
  void set_reference(const GeoPose& pose);
  Eigen::Vector3d position_error(const Eigen::Vector3d& position_W, const Sky& sky);
  FixReading fix(TimeNs now_ns, const Eigen::Vector3d& measured_W, const Sky& sky,
                 const Eigen::Vector3d& variance_m2) const;

  const LocalFrame initial_frame_on_earth_;
  LocalFrame frame_on_earth_;
  SensorModel position_;
  SensorModel velocity_;
  const int initial_status_;
  const int initial_service_;
  int status_;
  int service_;
  std::string frame_;
  Output& fix_output_;
  Output& velocity_output_;
};

}  // namespace ardee::devices
