// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/triangle_mesh.h"

#include "ardee_sim/core/error.h"

namespace ardee::physics {
namespace {

static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float),
              "vertices are passed on as packed floats");
static_assert(sizeof(dTriIndex) == sizeof(std::uint32_t), "indices are passed on as they are");

bool is_used(const SubMesh& part, const Mesh& mesh) {
  return mesh.submesh.empty() || part.name == mesh.submesh;
}

Eigen::AlignedBox3f raw_bounds(const Mesh& mesh) {
  Eigen::AlignedBox3f bounds;
  for (const SubMesh& part : mesh.file->parts) {
    if (!is_used(part, mesh)) continue;
    for (const Eigen::Vector3f& vertex : part.vertices) bounds.extend(vertex);
  }
  if (bounds.isEmpty()) {
    throw Error("mesh '" + mesh.uri + "': found no vertices" +
                (mesh.submesh.empty() ? "" : " in submesh '" + mesh.submesh + "'"));
  }
  return bounds;
}

Eigen::Vector3f centre_shift(const Mesh& mesh, const Eigen::AlignedBox3f& bounds) {
  return mesh.center ? bounds.center().eval() : Eigen::Vector3f::Zero().eval();
}

void append_part(const SubMesh& part, const Eigen::Vector3f& shift, const Eigen::Vector3f& scale,
                 TriangleMesh& result) {
  const auto first = static_cast<std::uint32_t>(result.vertices.size());
  for (const Eigen::Vector3f& vertex : part.vertices) {
    result.vertices.push_back((vertex - shift).cwiseProduct(scale));
    result.bounds.extend(result.vertices.back().cast<double>());
  }
  for (const auto& triangle : part.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= part.vertices.size()) {
        throw Error("mesh part '" + part.name +
                    "': found a triangle with a corner that does not exist");
      }
    }
    result.triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
  }
}

std::shared_ptr<TriangleMesh> build(const Mesh& mesh, const Eigen::Vector3f& scale) {
  auto result = std::make_shared<TriangleMesh>();
  const Eigen::Vector3f shift = centre_shift(mesh, raw_bounds(mesh));
  for (const SubMesh& part : mesh.file->parts) {
    if (is_used(part, mesh)) append_part(part, shift, scale, *result);
  }
  if (result->triangles.empty()) throw Error("mesh '" + mesh.uri + "': found no triangles");
  // A mirrored mesh keeps its outward orientation.
  if (scale.prod() < 0.0f) {
    for (auto& triangle : result->triangles) std::swap(triangle[1], triangle[2]);
  }
  result->tree.emplace(result->vertices);
  result->data.reset(dGeomTriMeshDataCreate());
  dGeomTriMeshDataBuildSingle(result->data.get(), result->vertices.data(), sizeof(Eigen::Vector3f),
                              static_cast<int>(result->vertices.size()), result->triangles.data(),
                              static_cast<int>(3 * result->triangles.size()),
                              sizeof(result->triangles[0]));
  return result;
}

}  // namespace

Eigen::AlignedBox3d mesh_bounds(const Mesh& mesh) {
  const Eigen::AlignedBox3f raw = raw_bounds(mesh);
  const Eigen::Vector3f shift = centre_shift(mesh, raw);
  Eigen::AlignedBox3d bounds;
  bounds.extend((raw.min() - shift).cast<double>().cwiseProduct(mesh.scale));
  bounds.extend((raw.max() - shift).cast<double>().cwiseProduct(mesh.scale));
  return bounds;
}

std::shared_ptr<const TriangleMesh> MeshCache::get(const Mesh& mesh, double scale) {
  const Eigen::Vector3d s = scale * mesh.scale;
  const Key key{mesh.file.get(), mesh.submesh, mesh.center, s.x(), s.y(), s.z()};
  std::weak_ptr<const TriangleMesh>& slot = meshes_[key];
  std::shared_ptr<const TriangleMesh> result = slot.lock();
  if (!result) {
    // The cache holds the file as well as the mesh, so that no other file can get its address.
    const auto built = build(mesh, s.cast<float>());
    const std::shared_ptr<const MeshFile> file = mesh.file;
    result =
        std::shared_ptr<const TriangleMesh>(built.get(), [built, file](const TriangleMesh*) {});
    slot = result;
  }
  return result;
}

}  // namespace ardee::physics
