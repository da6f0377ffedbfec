// SPDX-License-Identifier: MIT
#include "bench/triangle_soup.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/height_mesh.h"

namespace ardee::bench {

void TriangleSoup::add(const Model& model, const Pose& X, double scale,
                       const Eigen::Vector2d& center, double radius_m) {
  for (const Link& link : model.links) {
    for (const Visual& visual : link.visuals) {
      Pose X_MV = link.X_ML * visual.X_LV;
      X_MV.p *= scale;
      const Pose X_V = X * X_MV;
      if (const auto* mesh = std::get_if<Mesh>(&visual.geometry)) {
        add_mesh(*mesh, X_V, scale);
      } else if (const auto* map = std::get_if<Heightmap>(&visual.geometry)) {
        add_heightmap(*map, X_V, center, radius_m);
      } else if (const auto* plane = std::get_if<Plane>(&visual.geometry)) {
        add_plane(*plane, X_V);
      } else {
        throw Error(model.source, "visual '" + visual.name +
                                      "': found another shape, expected mesh, heightmap or plane");
      }
    }
  }
}

void TriangleSoup::add_mesh(const Mesh& mesh, const Pose& X, double scale) {
  if (mesh.center) throw Error("mesh '" + mesh.uri + "': found a centred one, expected none");
  for (const SubMesh& part : mesh.file->parts) {
    if (!mesh.submesh.empty() && part.name != mesh.submesh) continue;
    const auto base = static_cast<std::uint32_t>(vertices.size());
    for (const Eigen::Vector3f& vertex : part.vertices) {
      const Eigen::Vector3d scaled = scale * mesh.scale.cwiseProduct(vertex.cast<double>());
      vertices.push_back((X * scaled).cast<float>());
    }
    for (const auto& triangle : part.triangles) {
      triangles.push_back({base + triangle[0], base + triangle[1], base + triangle[2]});
    }
  }
}

void TriangleSoup::add_heightmap(const Heightmap& map, const Pose& X, const Eigen::Vector2d& center,
                                 double radius_m) {
  const HeightMesh mesh(map.grid);
  const Eigen::Vector2d middle = mesh.place(center - (X.p + map.position_m).head<2>());
  const auto range = [&](int axis, int count) {
    const double reach = radius_m / mesh.cell_size_m()[axis];
    return std::pair<int, int>{
        std::max(0, static_cast<int>(std::floor(middle[axis] - reach))),
        std::min(count - 1, static_cast<int>(std::ceil(middle[axis] + reach)))};
  };
  const auto [column_0, column_1] = range(0, mesh.grid().columns);
  const auto [row_0, row_1] = range(1, mesh.grid().rows);
  const auto base = static_cast<std::uint32_t>(vertices.size());
  const int width = column_1 - column_0 + 1;
  for (int row = row_0; row <= row_1; ++row) {
    for (int column = column_0; column <= column_1; ++column) {
      vertices.push_back((X * (map.position_m + mesh.vertex(column, row))).cast<float>());
    }
  }
  const auto at = [&](int column, int row) {
    return base + static_cast<std::uint32_t>((row - row_0) * width + (column - column_0));
  };
  for (int row = row_0; row < row_1; ++row) {
    for (int column = column_0; column < column_1; ++column) {
      for (const auto& cut : HeightMesh::kCut) {
        const auto corner = [&](int k) { return at(column + cut[k].column, row + cut[k].row); };
        triangles.push_back({corner(0), corner(1), corner(2)});
      }
    }
  }
}

void TriangleSoup::add_plane(const Plane& plane, const Pose& X) {
  const auto base = static_cast<std::uint32_t>(vertices.size());
  // The axes follow x and y as far as the normal allows; a normal along x is not expected.
  const Eigen::Vector3d across = plane.normal.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d along = across.cross(plane.normal).normalized();
  for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    const Eigen::Vector3d p = x * plane.size_m.x() * along + y * plane.size_m.y() * across;
    vertices.push_back((X * p).cast<float>());
  }
  triangles.push_back({base, base + 1, base + 2});
  triangles.push_back({base, base + 2, base + 3});
}

}  // namespace ardee::bench
