// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/ray_bundle.h"

#include <algorithm>

namespace ardee::raycast {

void BoxTable::clear() {
  for (int k = 0; k < 3; ++k) {
    lower[k].clear();
    upper[k].clear();
  }
}

void BoxTable::add(const Bounds& box) {
  for (int k = 0; k < 3; ++k) {
    lower[k].push_back(box.lower[k]);
    upper[k].push_back(box.upper[k]);
  }
}

RayBundle::RayBundle(const RayQuery* queries, int count)
    : origin_low_(queries[0].ray_W().origin),
      origin_high_(origin_low_),
      direction_low_(queries[0].ray_W().direction),
      direction_high_(direction_low_),
      reach_(queries[0].reach()) {
  for (int i = 1; i < count; ++i) {
    const Ray& ray = queries[i].ray_W();
    origin_low_ = origin_low_.min(ray.origin.array());
    origin_high_ = origin_high_.max(ray.origin.array());
    direction_low_ = direction_low_.min(ray.direction.array());
    direction_high_ = direction_high_.max(ray.direction.array());
    reach_ = std::max(reach_, queries[i].reach());
  }
}

RayBundle::RayBundle(const Eigen::Vector3d& eye_W, const PrimaryRayPacket& block)
    : origin_low_(eye_W), origin_high_(eye_W) {
  Eigen::Array3f low = block.direction_W(0);
  Eigen::Array3f high = low;
  float start_m = block.near_m[0];
  float reach_m = 0.0f;
  for (int i = 0; i < PrimaryRayPacket::kRays; ++i) {
    low = low.min(block.direction_W(i).array());
    high = high.max(block.direction_W(i).array());
    start_m = std::min(start_m, block.near_m[i]);
    reach_m = std::max(reach_m, std::min(block.far_m[i], block.range_m[i]));
  }
  direction_low_ = low.cast<double>();
  direction_high_ = high.cast<double>();
  start_ = static_cast<double>(start_m);
  reach_ = static_cast<double>(reach_m);
}

// Along each axis the rays are at t between origin_low + t direction_low and origin_high + t
// direction_high; they are beside the box unless the former is below its upper side and the latter
// above its lower one. A direction of zero has an infinite inverse, of the sign that makes it a
// condition on the origin; 0 * infinity is NaN, which the order of the comparisons lets pass.
void RayBundle::find(const BoxTable& boxes, std::vector<double>& entries,
                     std::vector<double>& exits, std::vector<std::uint32_t>& near) const {
  const std::size_t count = boxes.size();
  entries.assign(count, start_);
  exits.assign(count, reach_);
  double* const t_in = entries.data();
  double* const t_out = exits.data();
  const auto at_least = [&](const double* side, double origin, double inverse) {
    for (std::size_t i = 0; i < count; ++i) {
      const double t = (side[i] - origin) * inverse;
      t_in[i] = t > t_in[i] ? t : t_in[i];
    }
  };
  const auto at_most = [&](const double* side, double origin, double inverse) {
    for (std::size_t i = 0; i < count; ++i) {
      const double t = (side[i] - origin) * inverse;
      t_out[i] = t < t_out[i] ? t : t_out[i];
    }
  };
  for (int k = 0; k < 3; ++k) {
    const double low = direction_low_[k];
    const double high = direction_high_[k];
    if (low < 0.0) {
      at_least(boxes.upper[k].data(), origin_low_[k], 1.0 / low);
    } else {
      at_most(boxes.upper[k].data(), origin_low_[k], 1.0 / std::abs(low));
    }
    if (high > 0.0) {
      at_least(boxes.lower[k].data(), origin_high_[k], 1.0 / high);
    } else {
      at_most(boxes.lower[k].data(), origin_high_[k], -1.0 / std::abs(high));
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    if (t_in[i] <= t_out[i]) near.push_back(i);
  }
}

}  // namespace ardee::raycast
