// SPDX-License-Identifier: MIT
#include "ros/ground_marker.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/description/height_mesh.h"
#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr double kFinestCell_m = 0.1;

/// Corners of the thinned grid: every k-th column and row, and the last.
class ThinGrid {
 public:
  explicit ThinGrid(const Heightmap& heightmap)
      : mesh_(heightmap.grid), position_m_(heightmap.position_m) {
    const double cell_m = std::max(mesh_.cell_size_m().x(), 1e-6);
    stride_ = std::max(1, static_cast<int>(std::ceil(kFinestCell_m / cell_m)));
    const std::vector<float>& heights_m = mesh_.grid().heights_m;
    const auto [low, high] = std::minmax_element(heights_m.begin(), heights_m.end());
    low_m_ = *low;
    range_m_ = std::max(1e-6f, *high - *low);
  }

  int columns() const { return (mesh_.grid().columns - 2) / stride_ + 2; }
  int rows() const { return (mesh_.grid().rows - 2) / stride_ + 2; }
  /// The cell at a point; beyond the grid if the point is.
  HeightMesh::Cell cell_of(const Eigen::Vector2d& point_m) const {
    const Eigen::Vector2d place = mesh_.place(point_m - position_m_.head<2>()) / stride_;
    const auto index = [](double at) {
      return static_cast<int>(std::clamp(std::floor(at), -1.0, 1e6));
    };
    return {index(place.x()), index(place.y())};
  }

  Eigen::Vector3d corner(int column, int row) const {
    return position_m_ + mesh_.vertex(std::min(column * stride_, mesh_.grid().columns - 1),
                                      std::min(row * stride_, mesh_.grid().rows - 1));
  }
  /// 0 at the lowest corner of the whole map, 1 at the highest.
  double height_fraction(const Eigen::Vector3d& corner) const {
    return (corner.z() - position_m_.z() - low_m_) / range_m_;
  }

 private:
  HeightMesh mesh_;
  Eigen::Vector3d position_m_;
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
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(radius);
  const HeightMesh::Cell first = grid.cell_of(near.min().head<2>() - reach);
  const HeightMesh::Cell last = grid.cell_of(near.max().head<2>() + reach);
  const int last_column = std::min(grid.columns() - 2, last.column);
  const int last_row = std::min(grid.rows() - 2, last.row);

  const auto add = [&](const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d normal =
        (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    for (const Eigen::Vector3d& corner : corners) {
      marker.points.push_back(to_point(corner));
      marker.colors.push_back(earth(normal, grid.height_fraction(corner)));
    }
  };
  for (int row = std::max(0, first.row); row <= last_row; ++row) {
    for (int column = std::max(0, first.column); column <= last_column; ++column) {
      if (!is_near(grid.corner(column, row), eyes, radius)) continue;
      for (const auto& cut : HeightMesh::kCut) {
        const auto corner = [&](int k) {
          return grid.corner(column + cut[k].column, row + cut[k].row);
        };
        add({corner(0), corner(1), corner(2)});
      }
    }
  }
}

}  // namespace ardee::node
