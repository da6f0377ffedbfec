// SPDX-License-Identifier: MIT
#include "ros/ground_marker.h"

#include <algorithm>
#include <cmath>

#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr double kFinestCell_m = 0.1;

/// Corners of the thinned grid: every k-th column and row, and the last.
class ThinGrid {
 public:
  explicit ThinGrid(const Heightmap& heightmap)
      : grid_(*heightmap.grid), position_m_(heightmap.position_m) {
    cell_x_m_ = grid_.size_m.x() / std::max(1, grid_.columns - 1);
    cell_y_m_ = grid_.size_m.y() / std::max(1, grid_.rows - 1);
    stride_ = std::max(1, static_cast<int>(std::ceil(kFinestCell_m / std::max(cell_x_m_, 1e-6))));
    const auto [low, high] = std::minmax_element(grid_.heights_m.begin(), grid_.heights_m.end());
    low_m_ = *low;
    range_m_ = std::max(1e-6f, *high - *low);
  }

  int columns() const { return (grid_.columns - 2) / stride_ + 2; }
  int rows() const { return (grid_.rows - 2) / stride_ + 2; }
  int column_of(double x_m) const {
    return index(x_m, position_m_.x(), grid_.size_m.x(), cell_x_m_);
  }
  int row_of(double y_m) const { return index(y_m, position_m_.y(), grid_.size_m.y(), cell_y_m_); }

  Eigen::Vector3d corner(int column, int row) const {
    const int c = std::min(column * stride_, grid_.columns - 1);
    const int r = std::min(row * stride_, grid_.rows - 1);
    return position_m_ + Eigen::Vector3d(c * cell_x_m_ - grid_.size_m.x() / 2.0,
                                         r * cell_y_m_ - grid_.size_m.y() / 2.0, grid_.at(c, r));
  }
  /// 0 at the lowest corner of the whole map, 1 at the highest.
  double height_fraction(const Eigen::Vector3d& corner) const {
    return (corner.z() - position_m_.z() - low_m_) / range_m_;
  }

 private:
  int index(double at_m, double center_m, double size_m, double cell_m) const {
    const double cells = (at_m - center_m + size_m / 2.0) / std::max(cell_m, 1e-6) / stride_;
    return static_cast<int>(std::clamp(std::floor(cells), -1.0, 1e6));
  }

  const HeightGrid& grid_;
  Eigen::Vector3d position_m_;
  double cell_x_m_ = 0.0;
  double cell_y_m_ = 0.0;
  int stride_ = 1;
  float low_m_ = 0.0f;
  float range_m_ = 1.0f;
};

/// Brown earth, lighter on heights and on slopes that face the light.
std_msgs::ColorRGBA earth(const Eigen::Vector3d& normal, double height_fraction) {
  const Eigen::Vector3d light = Eigen::Vector3d(0.4, -0.5, 1.0).normalized();
  const double shade = (0.35 + 0.65 * std::max(0.0, normal.dot(light))) *
                       (0.8 + 0.3 * std::clamp(height_fraction, 0.0, 1.0));
  std_msgs::ColorRGBA color;
  color.r = static_cast<float>(0.52 * shade);
  color.g = static_cast<float>(0.40 * shade);
  color.b = static_cast<float>(0.27 * shade);
  color.a = 1.0f;
  return color;
}

bool is_near(const Eigen::Vector3d& point, const std::vector<Eigen::Vector3d>& eyes,
             double radius_m) {
  return std::any_of(eyes.begin(), eyes.end(), [&](const Eigen::Vector3d& eye) {
    return (eye - point).head<2>().norm() <= radius_m;
  });
}

}  // namespace

void append_ground(const Heightmap& heightmap, const Pose& X_WV, double scale,
                   const std::vector<Eigen::Vector3d>& eyes_W, double radius_m,
                   visualization_msgs::Marker& marker) {
  if (heightmap.grid->columns < 2 || heightmap.grid->rows < 2 || eyes_W.empty()) return;
  const ThinGrid grid(heightmap);
  std::vector<Eigen::Vector3d> eyes;  // in the heightmap's own frame and scale
  for (const Eigen::Vector3d& eye : eyes_W) eyes.push_back(X_WV.inverse() * eye / scale);
  const double radius = radius_m / scale;
  Eigen::AlignedBox3d near;
  for (const Eigen::Vector3d& eye : eyes) near.extend(eye);
  const int first_column = std::max(0, grid.column_of(near.min().x() - radius));
  const int first_row = std::max(0, grid.row_of(near.min().y() - radius));
  const int last_column = std::min(grid.columns() - 2, grid.column_of(near.max().x() + radius));
  const int last_row = std::min(grid.rows() - 2, grid.row_of(near.max().y() + radius));

  const auto add = [&](const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (const Eigen::Vector3d& corner : corners) {
      marker.points.push_back(to_point(corner));
      marker.colors.push_back(earth(normal, grid.height_fraction(corner)));
    }
  };
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const Eigen::Vector3d a = grid.corner(column, row);
      if (!is_near(a, eyes, radius)) continue;
      const Eigen::Vector3d b = grid.corner(column + 1, row);
      const Eigen::Vector3d c = grid.corner(column + 1, row + 1);
      const Eigen::Vector3d d = grid.corner(column, row + 1);
      add({a, b, c});
      add({a, c, d});
    }
  }
}

}  // namespace ardee::node
