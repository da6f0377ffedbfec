// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "ardee_sim/description/geometry.h"
#include "ardee_sim/physics/ode_types.h"
#include "ardee_sim/physics/vertex_tree.h"

namespace ardee::physics {

/// The triangles of a Mesh, scaled and centred, in ODE's form.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  Eigen::AlignedBox3d bounds;
  TriMeshDataHandle data;
  std::optional<VertexTree> tree;  // of those vertices
};

/// Bounds of a mesh as scaled and centred, without building it.
Eigen::AlignedBox3d mesh_bounds(const Mesh& mesh);

/// Cache of the meshes built so far: shapes that use one part at one scale share a mesh.
class MeshCache {
 public:
  std::shared_ptr<const TriangleMesh> get(const Mesh& mesh, double scale);

 private:
  using Key = std::tuple<const MeshFile*, std::string, bool, double, double, double>;

  std::map<Key, std::weak_ptr<const TriangleMesh>> meshes_;
};

}  // namespace ardee::physics
