// SPDX-License-Identifier: MIT
#include "ardee_sim/render/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardee::render {
namespace {

/// Returns a spot's share at an angle off its axis, faded as in OGRE.
double spot_share(const Light& light, double angle_rad) {
  const double inner = std::cos(0.5 * light.inner_angle_rad);
  const double outer = std::cos(0.5 * light.outer_angle_rad);
  const double cosine = std::cos(angle_rad);
  if (cosine >= inner) return 1.0;
  if (cosine <= outer || inner <= outer) return 0.0;
  return std::pow((cosine - outer) / (inner - outer), std::max(light.falloff, 1e-3));
}

}  // namespace

std::optional<Illumination> illuminate(const Light& light, const Eigen::Vector3d& point_W) {
  Illumination found;
  found.color = light.diffuse.head<3>();
  const Eigen::Vector3d axis_W = light.pose.q * light.direction;
  if (light.type == Light::Type::kDirectional) {
    if (!(axis_W.norm() > 0.0)) return std::nullopt;
    found.to_light_W = -axis_W.normalized();
    found.distance_m = std::numeric_limits<double>::infinity();
    return found;
  }
  const Eigen::Vector3d way = light.pose.p - point_W;
  found.distance_m = way.norm();
  if (!(found.distance_m > 0.0) || found.distance_m > light.range_m) return std::nullopt;
  found.to_light_W = way / found.distance_m;
  const double d = found.distance_m;
  const double divisor = light.attenuation_constant + light.attenuation_linear * d +
                         light.attenuation_quadratic * d * d;
  double share = divisor > 0.0 ? std::min(1.0 / divisor, 1.0) : 1.0;
  if (light.type == Light::Type::kSpot && axis_W.norm() > 0.0) {
    const double cosine = -found.to_light_W.dot(axis_W.normalized());
    share *= spot_share(light, std::acos(std::clamp(cosine, -1.0, 1.0)));
  }
  if (!(share > 0.0)) return std::nullopt;
  found.color *= static_cast<float>(share);
  return found;
}

}  // namespace ardee::render
