// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace ardee::raycast {

constexpr std::uint32_t kNoEntity = 0xFFFFFFFFu;
constexpr std::uint32_t kAllLinks = 0xFFFFFFFFu;

/// First hit of a ray.
struct RayHit {
  float range_m = 0.0f;  // +inf: no hit within the maximum
  std::uint32_t entity =
      kNoEntity;  // the number given to add_scenery or add_model (plus the placement's index)
  std::uint32_t link = 0;   // index in the model's description
  std::uint32_t shape = 0;  // index of the visual or collision in the link
  std::uint32_t label = 0;
  float laser_retro = 0.0f;
  float reflectivity = 0.0f;          // laser_retro if given, else by the diffuse colour, 0 to 1
  Eigen::Vector3f normal_W{0, 0, 0};  // unit, towards the ray's origin
};

}  // namespace ardee::raycast
