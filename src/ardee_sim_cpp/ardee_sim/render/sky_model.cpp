// SPDX-License-Identifier: MIT
#include "ardee_sim/render/sky_model.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/render/srgb.h"

namespace ardee::render {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Illuminance of the sun outside the air [klx] (Darula, Kittler and Gueymard, Solar Energy 79,
/// 2005).
constexpr double kSolar_klx = 133.8;
/// Share of light that a field sends back (nominal: leaves and soil in sunlight, 0.15 to 0.25).
constexpr float kReflected = 0.2f;

/// Returns the transmittance of the air for sunlight, in red, green and blue.
Eigen::Array3d transmittance(double elevation_rad, double turbidity) {
  const double elevation_deg = elevation_rad * 180.0 / kPi;
  const double mass =
      1.0 / (std::sin(elevation_rad) + 0.50572 * std::pow(elevation_deg + 6.07995, -1.6364));
  const double beta = 0.04608 * turbidity - 0.04586;
  const Eigen::Array3d wave_um(0.610, 0.550, 0.465);
  return (-mass * (0.008735 * wave_um.pow(-4.08) + beta * wave_um.pow(-1.3))).exp();
}

/// Perez's five coefficients for one quantity, each linear in turbidity.
struct Perez {
  double slope[5];
  double offset[5];

  /// Returns the quantity relative to that at the zenith.
  double operator()(double turbidity, double angle, double sun_angle, double from_sun) const {
    const auto at = [&](double cosine, double gamma) {
      const auto k = [&](int i) { return slope[i] * turbidity + offset[i]; };
      return (1.0 + k(0) * std::exp(k(1) / cosine)) *
             (1.0 + k(2) * std::exp(k(3) * gamma) + k(4) * std::pow(std::cos(gamma), 2));
    };
    return at(std::max(std::cos(angle), 0.01), from_sun) / at(1.0, sun_angle);
  }
};

constexpr Perez kLuminance{{0.1787, -0.3554, -0.0227, 0.1206, -0.0670},
                           {-1.4630, 0.4275, 5.3251, -2.5771, 0.3703}};
constexpr Perez kX{{-0.0193, -0.0665, -0.0004, -0.0641, -0.0033},
                   {-0.2592, 0.0008, 0.2125, -0.8989, 0.0452}};
constexpr Perez kY{{-0.0167, -0.0950, -0.0079, -0.0441, -0.0109},
                   {-0.2608, 0.0092, 0.2102, -1.6537, 0.0529}};

double cubic(double a, double b, double c, double d, double at) {
  return ((a * at + b) * at + c) * at + d;
}

/// Luminance [kcd/m^2] and chromaticity of the zenith.
Eigen::Array3d zenith_xyY(double t, double sun_angle) {
  const double s = sun_angle;
  const double chi = (4.0 / 9.0 - t / 120.0) * (kPi - 2.0 * s);
  return {t * t * cubic(0.00166, -0.00375, 0.00209, 0.0, s) +
              t * cubic(-0.02903, 0.06377, -0.03202, 0.00394, s) +
              cubic(0.11693, -0.21196, 0.06052, 0.25886, s),
          t * t * cubic(0.00275, -0.00610, 0.00317, 0.0, s) +
              t * cubic(-0.04214, 0.08970, -0.04153, 0.00516, s) +
              cubic(0.15346, -0.26756, 0.06670, 0.26688, s),
          std::max(0.0, (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192)};
}

/// Returns the display value of a share of the noon sun's light.
Eigen::Vector3f encode(const Eigen::Vector3f& share) {
  return SkyModel::kNoonSun * share.array().pow(1.0f / 2.2f);
}

/// CIE's overcast sky relative to its zenith.
float overcast(double sine) { return static_cast<float>((1.0 + 2.0 * sine) / 3.0); }

float luminance(const Eigen::Vector3f& rgb) {
  return rgb.dot(Eigen::Vector3f(0.2126f, 0.7152f, 0.0722f));
}

/// Returns the integral of a sky's light over the hemisphere, weighted by the cosine, divided by
/// pi.
template <typename Sky>
Eigen::Vector3f on_level_ground(const Sky& sky) {
  constexpr int kRings = 24;
  constexpr int kParts = 48;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  // Rings of equal weight: the square of the sine of the angle from the zenith is even.
  for (int ring = 0; ring < kRings; ++ring) {
    const double square = (ring + 0.5) / kRings;
    for (int part = 0; part < kParts; ++part) {
      const double azimuth = 2.0 * kPi * (part + 0.5) / kParts;
      const double across = std::sqrt(square);
      sum += sky(Eigen::Vector3d(across * std::cos(azimuth), across * std::sin(azimuth),
                                 std::sqrt(1.0 - square)));
    }
  }
  return sum / (kRings * kParts);
}

}  // namespace

SkyModel::SkyModel(const Daylight& day)
    : to_sun_W_(day.to_sun_W()),
      sun_angle_rad_(std::acos(std::clamp(to_sun_W_.z(), -1.0, 1.0))),
      turbidity_(day.turbidity) {
  constexpr double kNoon_rad = kPi / 3.0;
  const Eigen::Array3d noon = transmittance(kNoon_rad, 3.0);
  const Eigen::Array3d direct = transmittance(0.5 * kPi - sun_angle_rad_, turbidity_);
  sun_ = (direct / noon).cast<float>();
  // One kcd/m^2 of the sky in the unit of the sun's light, which is lux over pi.
  clear_ = static_cast<float>(kPi / (kSolar_klx * noon[1]));
  const auto sine = static_cast<float>(to_sun_W_.z());
  const Eigen::Vector3f clear = on_level_ground([this](const auto& way) { return clear_sky(way); });
  const float direct_light = sine * sun_[1];
  const float diffuse_light = luminance(clear);
  const auto cloud = static_cast<float>(day.cloud);
  const float through = 1.0f - 0.75f * std::pow(cloud, 3.4f);
  const float all = through * (direct_light + diffuse_light);
  const float clear_share = diffuse_light / (direct_light + diffuse_light);
  const float diffuse = all * (clear_share + (1.0f - clear_share) * cloud * cloud);
  sun_ *= through * (1.0f - cloud * cloud);
  // The clear part of the sky is that between the clouds.
  const float between = 1.0f - cloud;
  clear_ *= between;
  constexpr float kLevel = 7.0f / 9.0f;  // level ground under CIE's sky, relative to its zenith
  overcast_ = (diffuse - between * diffuse_light) / kLevel;
  from_sky_ = between * clear + Eigen::Vector3f::Constant(overcast_ * kLevel);
  from_ground_ = kReflected * (from_sky_ + sine * sun_);
}

Eigen::Vector3f SkyModel::clear_sky(const Eigen::Vector3d& direction_W) const {
  const double angle = std::acos(std::clamp(direction_W.z(), 0.0, 1.0));
  const double from_sun = std::acos(std::clamp(direction_W.dot(to_sun_W_), -1.0, 1.0));
  const Eigen::Array3d zenith = zenith_xyY(turbidity_, sun_angle_rad_);
  return clear_ * linear_srgb(zenith[0] * kX(turbidity_, angle, sun_angle_rad_, from_sun),
                              zenith[1] * kY(turbidity_, angle, sun_angle_rad_, from_sun),
                              zenith[2] * kLuminance(turbidity_, angle, sun_angle_rad_, from_sun));
}

Eigen::Vector3f SkyModel::sky(const Eigen::Vector3d& direction_W) const {
  return clear_sky(direction_W) +
         Eigen::Vector3f::Constant(overcast_ * overcast(std::max(direction_W.z(), 0.0)));
}

Eigen::Vector3f SkyModel::sun() const { return encode(sun_); }

Eigen::Vector3f SkyModel::color(const Eigen::Vector3d& direction_W) const {
  return encode(direction_W.z() >= 0.0 ? sky(direction_W) : from_ground_);
}

Eigen::Vector3f SkyModel::ambient(const Eigen::Vector3d& normal_W) const {
  const auto up = static_cast<float>(0.5 * (1.0 + std::clamp(normal_W.z(), -1.0, 1.0)));
  return encode(up * from_sky_ + from_ground_);  // leaves about it send back as much as the ground
}

}  // namespace ardee::render
