// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/ray_block.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/devices/sdf_noise.h"

namespace ardee::devices {
namespace {

constexpr int kMostRays = 1 << 22;
constexpr double kTwoTurns = 4.0 * M_PI;

const Element& required_block(const Element& parent, const char* name) {
  const Element* block = parent.child(name);
  if (!block) throw Error(parent.source, "found no <" + std::string(name) + ">, expected one");
  return *block;
}

/// Gazebo reads a whole number and ignores any text after it.
int read_samples(Parameters& direction, int fallback, Log& log) {
  const double written = direction.number("samples", fallback, 1, kMostRays);
  const double samples = std::floor(written);
  if (samples != written) {
    log.warn(direction
                 .error("samples", "expected a whole number: it is cut to " +
                                       std::to_string(static_cast<int>(samples)))
                 .what());
  }
  const double rays =
      std::round(samples * direction.number("resolution", 1.0, 1e-6, limits::kMostFactor));
  if (rays > kMostRays) {
    throw direction.error("resolution", "expected up to " + std::to_string(kMostRays) +
                                            " rays with that many samples");
  }
  return std::max(static_cast<int>(rays), 1);
}

void read_scan(const Element& scan, RayBlock& block, Log& log) {
  Parameters horizontal(required_block(scan, "horizontal"));
  block.columns = read_samples(horizontal, 640, log);
  block.angle_min_rad = horizontal.number("min_angle", 0.0, -kTwoTurns, kTwoTurns);
  block.angle_max_rad = horizontal.number("max_angle", 0.0, -kTwoTurns, kTwoTurns);
  const Element* given = scan.child("vertical");
  if (!given) return;
  Parameters vertical(*given);
  block.rows = read_samples(vertical, 1, log);
  block.elevation_min_rad = vertical.number("min_angle", 0.0, -kTwoTurns, kTwoTurns);
  block.elevation_max_rad = vertical.number("max_angle", 0.0, -kTwoTurns, kTwoTurns);
  if (block.rows > 1 && block.elevation_max_rad <= block.elevation_min_rad) {
    throw vertical.error("max_angle", "expected more than <min_angle>");
  }
  if (block.rays() > static_cast<std::size_t>(kMostRays)) {
    throw Error(scan.source, "found " + std::to_string(block.columns) + " x " +
                                 std::to_string(block.rows) + " rays, expected up to " +
                                 std::to_string(kMostRays));
  }
}

void read_range(const Element& range, RayBlock& block) {
  Parameters parameters(range);
  block.range_min_m = parameters.number("min", 0.0, 0.0, limits::kFarthest_m);
  block.range_max_m = parameters.number("max", 0.0, 0.0, limits::kFarthest_m);
  if (block.range_max_m <= block.range_min_m) {
    throw parameters.error("max", "expected more than <min>");
  }
  // The precision is only checked: Gazebo does not quantise ranges either.
  parameters.number("resolution", 0.0, 0.0, limits::kFarthest_m);
}

}  // namespace

RayBlock read_ray_block(const SensorDescription& sensor, Log& log) {
  RayBlock block;
  const Element* ray = sensor.element.child("ray");
  if (!ray) ray = sensor.element.child("lidar");
  if (!ray) {
    throw Error(sensor.element.source, "sensor '" + sensor.name + "' of type '" + sensor.type +
                                           "': found no <ray>, expected one");
  }
  read_scan(required_block(*ray, "scan"), block, log);
  read_range(required_block(*ray, "range"), block);
  if (const Element* given = ray->child("noise")) {
    const SdfNoise noise = read_sdf_noise(*given, true);
    block.noise.mean_m = noise.mean;
    block.noise.std_m = noise.std;
    block.noise.precision_m = noise.precision;
  }
  return block;
}

}  // namespace ardee::devices
