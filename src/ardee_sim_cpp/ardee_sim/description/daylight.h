// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace ardee {

/// Place of the sun, and the air that its light comes through.
struct Daylight {
  double azimuth_deg = 180.0;   // clockwise from north, which is the world's y axis
  double elevation_deg = 60.0;  // above the horizon
  double turbidity = 3.0;       // 2 a very clear day, 3 clear, 6 hazy, 10 the least clear
  double cloud = 0.0;           // share of the sky that clouds cover

  Eigen::Vector3d to_sun_W() const;
};

/// Throws Error if a number is not finite or out of its range: elevation 0 to 90, turbidity 2 to
/// 10, cloud 0 to 1.
void check_daylight(const Daylight& day);

}  // namespace ardee
