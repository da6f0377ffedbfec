// SPDX-License-Identifier: MIT
#include "ardee_sim/render/sky.h"

#include <algorithm>
#include <cmath>

namespace ardee::render {
namespace {

const Eigen::Vector3f kZenith(0.27f, 0.48f, 0.78f);
const Eigen::Vector3f kHorizon(0.80f, 0.87f, 0.92f);
const Eigen::Vector3f kHaze(0.74f, 0.78f, 0.80f);  // below the horizon, beyond the scenery
/// Share of the ambient light that a surface facing down gets, from the lit ground.
constexpr float kFromBelow = 0.5f;

}  // namespace

Sky::Sky(const Scene& scene, const std::optional<Daylight>& day) : scene_(scene) {
  if (day) model_.emplace(*day);
}

Eigen::Vector3f Sky::color(const Eigen::Vector3d& direction_W) const {
  if (model_) return model_->color(direction_W);
  if (!scene_.sky) return scene_.background.head<3>();
  const auto up = static_cast<float>(std::clamp(direction_W.z(), -1.0, 1.0));
  if (up < 0.0f) return kHorizon + std::min(1.0f, -8.0f * up) * (kHaze - kHorizon);
  return kHorizon + std::sqrt(up) * (kZenith - kHorizon);
}

Eigen::Vector3f Sky::ambient(const Eigen::Vector3d& normal_W) const {
  if (model_) return model_->ambient(normal_W);
  const Eigen::Vector3f all = scene_.ambient.head<3>();
  if (!scene_.sky) return all;
  const auto up = static_cast<float>(0.5 * (1.0 + std::clamp(normal_W.z(), -1.0, 1.0)));
  return (kFromBelow + (1.0f - kFromBelow) * up) * all;
}

}  // namespace ardee::render
