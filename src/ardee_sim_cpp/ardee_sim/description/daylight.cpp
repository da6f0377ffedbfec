// SPDX-License-Identifier: MIT
#include "ardee_sim/description/daylight.h"

#include <cmath>
#include <string>

#include "ardee_sim/core/error.h"

namespace ardee {
namespace {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

void check(const char* name, double found, double least, double most) {
  if (found >= least && found <= most) return;
  const auto text = [](double value) {
    std::string digits = std::to_string(value);
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits;
  };
  throw Error("daylight: found " + std::string(name) + " " + text(found) + ", expected " +
              text(least) + " to " + text(most));
}

}  // namespace

Eigen::Vector3d Daylight::to_sun_W() const {
  const double azimuth = azimuth_deg * kRadPerDeg;
  const double elevation = elevation_deg * kRadPerDeg;
  return {std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
          std::sin(elevation)};
}

void check_daylight(const Daylight& day) {
  check("azimuth_deg", day.azimuth_deg, -360.0, 360.0);
  check("elevation_deg", day.elevation_deg, 0.0, 90.0);
  check("turbidity", day.turbidity, 2.0, 10.0);
  check("cloud", day.cloud, 0.0, 1.0);
}

}  // namespace ardee
