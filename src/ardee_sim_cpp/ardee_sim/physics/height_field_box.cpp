// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>

#include "ardee_sim/physics/height_field_contacts.h"

namespace ardee::physics {
namespace {

using Eigen::Vector3d;

constexpr double kRidgeHeight = 1e-4;  // m: least rise of a ridge above its surroundings
constexpr int kMaxEdgePoints = 64;

Vector3d corner(const Box& box, int index) {
  const Vector3d sign((index & 1) ? 1 : -1, (index & 2) ? 1 : -1, (index & 4) ? 1 : -1);
  return 0.5 * box.size_m.cwiseProduct(sign);
}

/// Points between the ends of an edge touch only if the ground rises above the line between the
/// ground points under the ends.
void touch_edge(const HeightField& field, const Vector3d& start, const Vector3d& end,
                ContactPoints& contacts) {
  Vector3d normal;
  const double start_below_m = depth_below(field, start, normal);
  const double end_below_m = depth_below(field, end, normal);
  if (!std::isfinite(start_below_m) || !std::isfinite(end_below_m)) return;
  const double wanted = std::ceil(2.0 * (end - start).norm() / field.cell_size_m().minCoeff());
  const int pieces = static_cast<int>(std::min(wanted, static_cast<double>(kMaxEdgePoints)));
  for (int i = 1; i < pieces; ++i) {
    const double t = static_cast<double>(i) / pieces;
    const Vector3d point = (1.0 - t) * start + t * end;
    const double below_m = depth_below(field, point, normal);
    const double between_m = (1.0 - t) * start_below_m + t * end_below_m;
    if (below_m > 0.0 && below_m > between_m + kRidgeHeight) add_point(field, point, contacts);
  }
}

/// Whether a vertex of the ground rises above the line between two opposite neighbours, in any of
/// the four directions.
bool is_peak(const HeightField& field, int column, int row, const CellRange& all) {
  const double height = field.vertex(column, row).z();
  constexpr std::array<std::array<int, 2>, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  for (const auto& [dc, dr] : directions) {
    if (column - dc < 0 || column + dc > all.last_column + 1) continue;
    if (row - std::abs(dr) < 0 || row + std::abs(dr) > all.last_row + 1) continue;
    const double between =
        0.5 * (field.vertex(column - dc, row - dr).z() + field.vertex(column + dc, row + dr).z());
    if (height > between + kRidgeHeight) return true;
  }
  return false;
}

/// A peak inside the box leaves it by the nearest of the downward faces.
void touch_peak(const Pose& X_FB, const Box& box, const Vector3d& peak, ContactPoints& contacts) {
  const Vector3d local = X_FB.inverse() * peak;
  const Vector3d inside = 0.5 * box.size_m - local.cwiseAbs();
  if (inside.minCoeff() <= 0.0) return;
  ContactPoint best{peak, Vector3d::UnitZ(), 0.0};
  bool found = false;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d direction = X_FB.q * Vector3d::Unit(axis);
    const double outward = direction.z() > 0.0 ? -1.0 : 1.0;  // the downward face
    if (std::abs(direction.z()) < 1e-3) continue;
    const double depth_m = 0.5 * box.size_m[axis] - outward * local[axis];
    if (found && depth_m >= best.depth_m) continue;
    found = true;
    best.depth_m = depth_m;
    best.normal = -outward * direction;
  }
  if (found) add_contact(best, contacts);
}

}  // namespace

void collide_box(const HeightField& field, const Pose& X_FB, const Box& box,
                 ContactPoints& contacts) {
  const Eigen::Matrix3d R_FB = X_FB.q.toRotationMatrix();
  const Vector3d reach = 0.5 * R_FB.cwiseAbs() * box.size_m;
  const Vector3d low = X_FB.p - reach, high = X_FB.p + reach;
  const CellRange range = field.cells(low.x(), low.y(), high.x(), high.y());
  if (range.empty() || field.highest(range) < low.z()) return;
  for (int i = 0; i < 8; ++i) add_point(field, X_FB * corner(box, i), contacts);
  for (int i = 0; i < 8; ++i) {
    for (int bit = 1; bit < 8; bit <<= 1) {
      if (i & bit) continue;
      touch_edge(field, X_FB * corner(box, i), X_FB * corner(box, i | bit), contacts);
    }
  }
  const CellRange all = field.cells(field.bounds().min().x(), field.bounds().min().y(),
                                    field.bounds().max().x(), field.bounds().max().y());
  for (int row = range.first_row; row <= range.last_row + 1; ++row) {
    for (int column = range.first_column; column <= range.last_column + 1; ++column) {
      const Vector3d vertex = field.vertex(column, row);
      if (vertex.z() < low.z() || !is_peak(field, column, row, all)) continue;
      touch_peak(X_FB, box, vertex, contacts);
    }
  }
}

}  // namespace ardee::physics
