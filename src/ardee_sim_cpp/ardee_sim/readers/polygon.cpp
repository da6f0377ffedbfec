// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/polygon.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace ardee {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Twice the area of a triangle, positive if it turns left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d ab = b - a;
  const Eigen::Vector2d ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

/// The corners on the plane of two axes on which the polygon is largest, turning left; empty if it
/// has no area.
std::vector<Eigen::Vector2d> flatten(const std::vector<Eigen::Vector3f>& corners) {
  const Eigen::Vector3d first = corners[0].cast<double>();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    normal += (corners[k].cast<double>() - first).cross(corners[k + 1].cast<double>() - first);
  }
  Eigen::Index axis = 0;
  if (!(normal.cwiseAbs().maxCoeff(&axis) > 0.0)) return {};
  Eigen::Index across = (axis + 1) % 3;
  Eigen::Index up = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(across, up);
  std::vector<Eigen::Vector2d> flat;
  for (const Eigen::Vector3f& corner : corners) {
    const Eigen::Vector3d place = corner.cast<double>() - first;
    flat.emplace_back(place[across], place[up]);
  }
  return flat;
}

/// Cuts off, one by one, corners whose triangle contains no other corner ("ear clipping", Meisters
/// 1975).
class EarClipping {
 public:
  explicit EarClipping(const std::vector<Eigen::Vector2d>& corners)
      : corners_(corners), left_(corners.size()) {
    std::iota(left_.begin(), left_.end(), 0u);
  }

  Triangles cut() {
    Triangles triangles;
    std::size_t at = 0;
    std::size_t tried = 0;
    while (left_.size() > 3) {
      // Where a polygon crosses itself there may be no ear: any corner is cut off then.
      if (!is_ear(at) && ++tried <= left_.size()) {
        at = (at + 1) % left_.size();
        continue;
      }
      tried = 0;
      add(at, triangles);
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(at));
      // Continues two corners on; otherwise the triangles would be a fan of slivers.
      at = (at + 1) % left_.size();
    }
    add(1, triangles);
    return triangles;
  }
  std::uint64_t work() const { return work_; }

 private:
  std::uint32_t before(std::size_t at) const {
    return left_[(at + left_.size() - 1) % left_.size()];
  }
  std::uint32_t after(std::size_t at) const { return left_[(at + 1) % left_.size()]; }

  void add(std::size_t at, Triangles& triangles) const {
    const std::array<std::uint32_t, 3> triangle{before(at), left_[at], after(at)};
    const double area = turn(corners_[triangle[0]], corners_[triangle[1]], corners_[triangle[2]]);
    if (area != 0.0) triangles.push_back(triangle);
  }

  bool is_ear(std::size_t at) {
    const Eigen::Vector2d& a = corners_[before(at)];
    const Eigen::Vector2d& b = corners_[left_[at]];
    const Eigen::Vector2d& c = corners_[after(at)];
    if (!(turn(a, b, c) > 0.0)) return false;
    work_ += left_.size();
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const Eigen::Vector2d& p = corners_[left_[k]];
      if (p == a || p == b || p == c) continue;
      // Skips corners that turn left: if there are points inside, one of them turns right.
      if (turn(corners_[before(k)], p, corners_[after(k)]) > 0.0) continue;
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  const std::vector<Eigen::Vector2d>& corners_;
  std::vector<std::uint32_t> left_;
  std::uint64_t work_ = 0;
};

}  // namespace

Triangles cut_polygon(const std::vector<Eigen::Vector3f>& corners, std::uint64_t* work) {
  if (corners.size() < 3) return {};
  const std::vector<Eigen::Vector2d> flat = flatten(corners);
  if (flat.empty()) return {};
  Triangles fan;
  for (std::uint32_t k = 1; k + 1 < flat.size(); ++k) {
    if (turn(flat[0], flat[k], flat[k + 1]) <= 0.0) {
      EarClipping clipping(flat);
      const Triangles triangles = clipping.cut();
      if (work) *work += clipping.work();
      return triangles;
    }
    fan.push_back({0, k, k + 1});
  }
  return fan;  // all of it is visible from its first corner, as if convex
}

}  // namespace ardee
