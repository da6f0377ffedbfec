// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "ardee_sim/raycast/bounds.h"
#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/ray_query.h"

namespace ardee::raycast {

/// Boxes side by side, for one pass of vector instructions.
struct BoxTable {
  std::vector<double> lower[3];
  std::vector<double> upper[3];

  std::size_t size() const { return lower[0].size(); }
  void clear();
  void add(const Bounds& box);
};

/// Bounds of a few neighbouring rays: the least and greatest of their origins, directions and
/// reaches.
class RayBundle {
 public:
  RayBundle(const RayQuery* queries, int count);
  /// Bundles a picture's rays from the eye, each up to its present hit.
  RayBundle(const Eigen::Vector3d& eye_W, const PrimaryRayPacket& block);

  /// Appends to `near` all boxes that a ray touches, and perhaps more. `entries` and `exits` are
  /// working memory.
  void find(const BoxTable& boxes, std::vector<double>& entries, std::vector<double>& exits,
            std::vector<std::uint32_t>& near) const;

 private:
  Eigen::Array3d origin_low_, origin_high_;
  Eigen::Array3d direction_low_, direction_high_;
  double start_ = 0.0;
  double reach_ = 0.0;
};

}  // namespace ardee::raycast
