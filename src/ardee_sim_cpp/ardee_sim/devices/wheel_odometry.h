// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/devices/robot.h"

namespace ardee::devices {

/// Dead reckoning of a vehicle with a left and a right side from the turns of its wheels.
class WheelOdometry {
 public:
  struct Params {
    std::vector<std::size_t> left_joints;
    std::vector<std::size_t> right_joints;
    double wheel_diameter_m = 0.15;
    double wheel_separation_m = 0.4;
  };

  WheelOdometry(const Params& params, const Robot& robot);

  /// Adds the wheels' turns since the last call. The vehicle moves along the chord of the arc:
  /// Siegwart and Nourbakhsh, Introduction to Autonomous Mobile Robots, eq. 5.7.
  void update();
  const Pose& pose() const { return pose_; }
  /// Twist by the wheels' present speeds, in the vehicle's axes.
  Twist twist() const;
  /// Begins anew at the origin, from the wheels' present angles.
  void reset();
  void serialize(StateArchive& state) { state(left_, right_, pose_); }

 private:
  struct Wheel {
    std::size_t joint = 0;
    double angle_rad = 0.0;  // at the last update
  };
  using Side = std::vector<Wheel>;

  double rolled_m(Side& side) const;
  double speed_m_per_s(const Side& side) const;

  const Robot& robot_;
  double wheel_radius_m_;
  double wheel_separation_m_;
  Side left_;
  Side right_;
  Pose pose_;
};

}  // namespace ardee::devices
