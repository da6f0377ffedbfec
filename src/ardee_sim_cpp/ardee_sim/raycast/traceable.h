// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "ardee_sim/description/model.h"
#include "ardee_sim/raycast/alpha_mask.h"
#include "ardee_sim/raycast/embree_scene.h"
#include "ardee_sim/raycast/height_patch.h"
#include "ardee_sim/raycast/triangle_block.h"

namespace ardee::raycast {

/// Data that the surface of one shape (or mesh part) shares.
struct TraceableSurface {
  std::uint32_t link = 0;
  std::uint32_t shape = 0;
  float laser_retro = 0.0f;
  float reflectivity = 0.0f;
  bool two_sided = true;
  std::shared_ptr<const AlphaMask> mask;  // null: no holes
  // Pictures alone use these.
  bool casts_shadows = true;
  const Visual* visual = nullptr;
  const Material* material = nullptr;
  const SubMesh* part = nullptr;                                  // the mesh's part
  std::uint32_t first_vertex = 0;                                 // the part's, in the body
  Eigen::Matrix3d normals_to_body = Eigen::Matrix3d::Identity();  // from the part's axes
};

struct TraceableTriangle {
  std::array<std::uint32_t, 3> vertices;
  std::uint32_t surface;
  std::uint32_t primitive;  // number within the shape
};

/// Shape with a formula, in its own axes at a place in the body.
struct AnalyticSolid {
  enum class Kind { kSphere, kBox, kCylinder, kRectangle, kGround };

  Kind kind = Kind::kBox;
  Eigen::Matrix3d R_BS = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_BS = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();  // half sizes; radius in x, half length in z
  std::uint32_t surface = 0;
};

/// A heightmap; its frame S is the height grid's own.
struct Terrain {
  HeightSurface heights;
  Eigen::Matrix3d R_BS;
  Eigen::Vector3d p_BS;
  std::uint32_t surface;
};

struct TerrainPatch {
  std::uint32_t terrain;
  HeightPatch cells;
};

/// Unit of traversal: sixteen triangles, a solid or a patch of terrain.
struct Primitive {
  enum class Kind : std::uint32_t { kBlock, kSolid, kPatch };

  Kind kind;
  std::uint32_t index;
};

/// Shapes of a description (or of one link, if it moves) as rays see them: built once for any
/// number of places.
struct Traceable {
  std::vector<TraceableSurface> surfaces;
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector2f> texcoords;    // as many as vertices if there are holes
  std::vector<TraceableTriangle> triangles;  // block by block
  std::vector<TriangleBlock> blocks;
  std::vector<AnalyticSolid> solids;
  std::vector<Terrain> terrains;
  std::vector<TerrainPatch> patches;
  std::vector<Primitive> primitives;
  std::vector<Bounds> primitive_bounds;  // in the body's frame
  std::vector<std::uint32_t> grounds;    // infinite planes among the solids: not primitives
  Bounds bounds;                         // all primitives
  std::unique_ptr<EmbreeScene> scene;    // over the primitives, if they are many

  std::size_t triangle_count() const { return triangles.size(); }
};

using TraceableBodies = std::vector<std::unique_ptr<const Traceable>>;

/// Body at a place in the world: p_W = p + q * (scale * p_B).
struct TraceableInstance {
  const Traceable* body = nullptr;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  double scale = 1.0;
  std::uint32_t entity = 0;
  std::uint32_t label = 0;

  Ray to_body(const Ray& ray_W) const {
    const Eigen::Quaterniond inverse = q.conjugate();
    return {inverse * (ray_W.origin - p) / scale, inverse * ray_W.direction / scale};
  }
  Bounds bounds_W() const { return body->bounds.transformed(q.toRotationMatrix() * scale, p); }
};

}  // namespace ardee::raycast
