// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/devices/device.h"

namespace ardee {

/// What all sensors share: where they sit and when they measure. A subclass says what is measured.
class Sensor : public Device {
 public:
  struct Mount {
    Robot& robot;
    std::size_t link = 0;
    Pose X_LS;
    double rate_hz = 0.0;    // 0: at each step
    std::uint64_t seed = 0;  // of the robot; the sensor's own stream is derived from it by name
  };

  Sensor(const std::string& name, const Mount& mount);

  void after_step(TimeNs now_ns, ReadingSink& sink) final;
  void reset(TimeNs now_ns) override;

 protected:
  /// Measures and corrupts with `noise`, a stream of this frame's own; called when due and wanted.
  virtual void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) = 0;
  /// True if somebody listens to any output.
  virtual bool wanted() const = 0;
  Pose pose() const { return mount_.robot.link_pose(mount_.link) * mount_.X_LS; }
  const Mount& mount() const { return mount_; }

 private:
  Mount mount_;
  RateTimer timer_;
  CounterRng stream_;
};

}  // namespace ardee
