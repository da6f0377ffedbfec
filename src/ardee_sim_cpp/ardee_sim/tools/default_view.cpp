// SPDX-License-Identifier: MIT
#include "ardee_sim/tools/default_view.h"

#include <algorithm>
#include <cmath>

namespace ardee {
namespace {

/// A box that is this much wider than high is ground.
constexpr double kGroundRatio = 20.0;
constexpr double kAwayAtLeast_m = 1.0;
/// Direction from the scenery's middle towards the camera.
const Eigen::Vector3d kAside(-0.75, -1.0, 0.6);
/// Margin around the outermost corners.
constexpr double kRoom = 1.05;

bool is_ground(const raycast::Bounds& box) {
  const Eigen::Vector3d size = box.upper - box.lower;
  return size.head<2>().maxCoeff() > kGroundRatio * size.z();
}

}  // namespace

Pose view_over(const std::vector<raycast::Bounds>& boxes_W, const render::Camera& camera) {
  raycast::Bounds things;
  raycast::Bounds all;
  for (const raycast::Bounds& box : boxes_W) {
    all.add(box);
    if (!is_ground(box)) things.add(box);
  }
  const raycast::Bounds& shown = things.empty() ? all : things;
  if (shown.empty()) return render::look_at(kAside.normalized() * kAwayAtLeast_m, {0, 0, 0});
  const Eigen::Vector3d aside = kAside.normalized();
  const Eigen::Quaterniond inverse = render::look_at(aside, {0, 0, 0}).q.conjugate();
  const double half_width = 0.5 * camera.width / camera.focal_length_px();
  const double half_height = 0.5 * camera.height / camera.focal_length_px();
  double away_m = kAwayAtLeast_m;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d corner((k & 1) != 0 ? shown.upper.x() : shown.lower.x(),
                                 (k & 2) != 0 ? shown.upper.y() : shown.lower.y(),
                                 (k & 4) != 0 ? shown.upper.z() : shown.lower.z());
    const Eigen::Vector3d p = inverse * (corner - shown.center());
    const double needed = std::max(std::abs(p.y()) / half_width, std::abs(p.z()) / half_height);
    away_m = std::max(away_m, kRoom * needed - p.x());
  }
  return render::look_at(shown.center() + away_m * aside, shown.center());
}

}  // namespace ardee
