// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "ardee_sim/description/daylight.h"

namespace ardee::render {

/// Light of sun and sky for a time of day, turbid air and clouds.
///
/// Direct light: the air mass of Kasten and Young (Applied Optics 28, 1989), and the transmittances
/// of Rayleigh scattering and aerosol of Preetham, Shirley and Smits (SIGGRAPH 1999, appendix 1) at
/// 610, 550 and 465 nm. Clear sky: their luminance and chromaticity by Perez's formula (appendix
/// 2). Overcast sky: CIE's, three times as bright above as at the horizon. Clouds: global light and
/// its diffuse share by Kasten and Czeplak (Solar Energy 24, 1980).
///
/// All light is relative to that on a white surface that faces the clear noon sun (60 degrees,
/// turbidity 3), and encoded: materials and textures have display values, and shading multiplies
/// them as Gazebo does, so a share of that light is returned as kNoonSun * share^(1 / 2.2). Light
/// of the sun below the horizon is not modelled.
class SkyModel {
 public:
  static constexpr float kNoonSun = 0.8f;

  explicit SkyModel(const Daylight& day);

  /// Light of the sun on a white surface that faces it.
  Eigen::Vector3f sun() const;
  /// Light that comes from a direction above the horizon; below, that of the lit ground.
  Eigen::Vector3f color(const Eigen::Vector3d& direction_W) const;
  /// Light of sky and surroundings on a white surface with this normal.
  Eigen::Vector3f ambient(const Eigen::Vector3d& normal_W) const;

 private:
  // Shares of the noon sun's light, not encoded:
  Eigen::Vector3f clear_sky(const Eigen::Vector3d& direction_W) const;
  Eigen::Vector3f sky(const Eigen::Vector3d& direction_W) const;

  Eigen::Vector3d to_sun_W_;
  double sun_angle_rad_;  // from the zenith
  double turbidity_;
  float clear_ = 1.0f;     // factor on the clear sky
  float overcast_ = 0.0f;  // light at the zenith of the overcast one
  Eigen::Vector3f sun_;
  Eigen::Vector3f from_sky_;     // light of the whole sky on level ground
  Eigen::Vector3f from_ground_;  // light that the ground sends back
};

}  // namespace ardee::render
