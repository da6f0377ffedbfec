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

/// All that a few neighbouring rays can touch: every origin, direction and reach between the least
/// and the greatest of theirs.
class RayBundle {
 public:
  RayBundle(const RayQuery* queries, int count);
  /// Of a picture's rays from the eye, as far as they have met nothing.
  RayBundle(const Eigen::Vector3d& eye_W, const PrimaryRayPacket& block);

  /// Appends to `near` the boxes that one of the rays may touch: none that it does touch is left
  /// out. `entries` and `exits` are room for the work.
  void find(const BoxTable& boxes, std::vector<double>& entries, std::vector<double>& exits,
            std::vector<std::uint32_t>& near) const;

 private:
  Eigen::Array3d origin_low_, origin_high_;
  Eigen::Array3d direction_low_, direction_high_;
  double start_ = 0.0;
  double reach_ = 0.0;
};

}  // namespace ardee::raycast
