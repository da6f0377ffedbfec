// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/range_noise.h"

namespace ardee::devices {

/// SDF's <ray> block: rays from one point over a grid of angles, and the limits and errors of their
/// ranges. Column i leaves at angle_min + i * increment about z; row j has an elevation by the same
/// formula, from the lowest up; a single row is level.
struct RayBlock {
  int columns = 640;           // SDF's samples * resolution
  double angle_min_rad = 0.0;  // may exceed angle_max_rad: the scan then runs backwards
  double angle_max_rad = 0.0;
  int rows = 1;
  double elevation_min_rad = 0.0;
  double elevation_max_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 10.0;
  RangeNoise noise;

  std::size_t rays() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  /// Angle between beams; 0 for a single one.
  double angle_increment_rad() const {
    return columns > 1 ? (angle_max_rad - angle_min_rad) / (columns - 1) : 0.0;
  }
  double elevation_increment_rad() const {
    return rows > 1 ? (elevation_max_rad - elevation_min_rad) / (rows - 1) : 0.0;
  }
  double azimuth_rad(int column) const { return angle_min_rad + column * angle_increment_rad(); }
  double elevation_rad(int row) const {
    return rows > 1 ? elevation_min_rad + row * elevation_increment_rad() : 0.0;
  }
};

/// Reads and checks a <ray> block.
RayBlock read_ray_block(const SensorDescription& sensor, Log& log);

}  // namespace ardee::devices
