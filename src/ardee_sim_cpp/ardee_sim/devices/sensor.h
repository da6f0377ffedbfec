// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// Base class of all sensors: their mounting and their times of measurement. A subclass defines the
/// measurement.
class Sensor : public Device {
 public:
  struct Mount {
    Robot& robot;
    std::size_t link = 0;
    Pose X_LS;
    double rate_hz = 0.0;    // 0: at each step
    std::uint64_t seed = 0;  // of the robot; the sensor's own stream is derived from it by name
    TimeNs offset_ns = 0;    // offset of the times of measurement
  };

  Sensor(const std::string& name, const Mount& mount);

  std::size_t link() const { return mount_.link; }
  void after_step(TimeNs now_ns, ReadingSink& sink) final;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override { state(timer_, last_ns_); }

 protected:
  /// Adds an output of the sensor's rate.
  Output& add_output(const std::string& topic, std::size_t kind, const std::string& frame_id) {
    return Device::add_output(topic, kind, mount_.rate_hz, frame_id);
  }
  /// Measures, and corrupts with `noise`, a stream for this frame only; called when due and wanted.
  virtual void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) = 0;
  /// Whether any output has a subscriber.
  virtual bool wanted() const = 0;
  /// Follows each step, also those at which no sample is due.
  virtual void follow(TimeNs /*now_ns*/) {}
  Pose pose() const { return mount_.robot.link_pose(mount_.link) * mount_.X_LS; }
  const Mount& mount() const { return mount_; }
  std::uint64_t noise_seed() const { return mount_.robot.noise_seed(); }
  /// Linear velocity of the sensor's origin and angular velocity, in world axes.
  Twist twist() const;
  /// Time since the previous sample, or the reset; for use in sample().
  double elapsed_s() const { return elapsed_s_; }

 private:
  Mount mount_;
  RateTimer timer_;
  CounterRng stream_;
  TimeNs last_ns_ = 0;
  double elapsed_s_ = 0.0;
};

/// The slower of two rates in Hz; 0 is no limit.
double slower_rate_hz(double one_hz, double other_hz);

/// Reads <updateRate> in Hz. 0 or below, as the stock plugins have it: at each step.
double read_update_rate_hz(Parameters& parameters, double fallback_hz);

/// Reads the times at which a hector_gazebo plugin measures: <updateRate> in Hz (0: at each step)
/// or <updatePeriod> in s, from <updateOffset> in s on.
void read_update_times(Parameters& parameters, double default_rate_hz, Sensor::Mount& mount);

}  // namespace ardee::devices
