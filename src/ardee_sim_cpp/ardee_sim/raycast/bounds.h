// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <limits>

namespace ardee::raycast {

/// Axis-aligned box, empty at first.
struct Bounds {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = -lower;

  bool empty() const { return !(lower.x() <= upper.x()); }
  void add(const Eigen::Vector3d& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  void add(const Bounds& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  Bounds grown(double margin) const {
    Bounds result = *this;
    result.lower.array() -= margin;
    result.upper.array() += margin;
    return result;
  }
  /// Returns one of the eight corners; bit k of its number chooses the upper end of axis k.
  Eigen::Vector3d corner(unsigned number) const {
    const Eigen::Vector3d share(number & 1u, number >> 1 & 1u, number >> 2 & 1u);
    return lower + share.cwiseProduct(upper - lower);
  }
  Eigen::Vector3d center() const { return 0.5 * (lower + upper); }
  double radius() const { return empty() ? 0.0 : 0.5 * (upper - lower).norm(); }
  /// Returns the box about this box turned by `m` and moved by `p`.
  Bounds transformed(const Eigen::Matrix3d& m, const Eigen::Vector3d& p) const {
    if (empty()) return {};
    const Eigen::Vector3d middle = m * center() + p;
    const Eigen::Vector3d half = m.cwiseAbs() * (0.5 * (upper - lower));
    Bounds result;
    result.lower = middle - half;
    result.upper = middle + half;
    return result;
  }
};

}  // namespace ardee::raycast
