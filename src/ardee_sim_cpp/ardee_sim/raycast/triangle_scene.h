// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/ray_query.h"
#include "ardee_sim/raycast/surface_texel.h"

namespace ardee::raycast {

/// Part of a placed body in a triangle scene: its triangles, and some patches of its terrains.
struct TriangleSource {
  const TraceableInstance* placed = nullptr;
  std::vector<std::uint32_t> patches;
  const std::uint64_t* moved_at = nullptr;  // not null: it may leave its place
};

/// Triangles of placed bodies in Embree's floats, with the data that a picture needs: several times
/// as quick as exact tests.
class TriangleScene {
 public:
  /// Builds the scene. Coordinates are relative to `origin_W`. The bodies must outlive the scene.
  /// Rays ignore bodies that have moved after `time`.
  TriangleScene(const std::vector<TriangleSource>& bodies, const Eigen::Vector3d& origin_W,
                std::uint64_t time);
  ~TriangleScene();

  /// Ray in the scene's coordinates, and the triangle that it has hit.
  struct Met {
    Eigen::Vector3f origin;
    Eigen::Vector3f direction;
    std::uint32_t triangle;  // triangle_of()
  };

  /// Returns one number for a triangle, from the two that Embree gives.
  static std::uint32_t triangle_of(std::uint32_t geometry, std::uint32_t primitive) {
    return geometry << kPartBit | primitive;
  }
  /// Finds the first hits of the rays of a picture's block, which start at `eye`.
  void trace_primary(const Eigen::Vector3f& eye, PrimaryRayPacket& block) const;
  /// Finds the triangle that each ray of the packet hits first.
  void intersect(RayPacket& packet) const;
  /// Makes tfar negative for rays with a body in their way.
  void find_shadows(RayPacket& packet) const;
  /// Computes a hit from the triangle alone, so that it does not depend on the processor's
  /// instructions. Leaves out a mesh's point_S.
  void fill(const Met& met, SurfaceInteraction& point) const;

  /// Number that no other triangle scene of this process has.
  std::uint64_t number() const { return number_; }
  /// Returns the texel where a ray has hit this triangle scene.
  SurfaceTexel texel(const TexelRequest& request) const;
  /// Computes the hit of a ray along the normal at a texel's middle; `at` is in the scene's
  /// coordinates.
  void fill(const SurfaceTexel& texel, Eigen::Vector3f& at, SurfaceInteraction& point) const;

  std::size_t bytes() const;

 private:
  static constexpr int kPartBit = 30;

  /// Surface of one placed body.
  struct Surface {
    const TraceableInstance* placed;
    const TraceableSurface* of_body;
    const Terrain* terrain;         // null: a mesh
    const std::uint64_t* moved_at;  // null: it does not move
  };
  struct Triangle {
    std::uint32_t corners[3];
    std::uint32_t surface;
    float uv_per_m;
    TriangleTexels texels;  // its base is the side from the first corner to the second
  };
  struct Vertex {
    Eigen::Vector3f normal{0, 0, 0};  // in the world; zero: the triangle's
    Eigen::Vector2f uv{0, 0};
  };
  /// Triangles that each ray hits, or those that need a test: with holes, without a back, without a
  /// shadow, of models that may leave.
  struct Part {
    const TriangleScene* scene = nullptr;
    std::vector<Triangle> triangles;
    std::vector<Eigen::Vector3f> places;  // vertices
    std::vector<Vertex> vertices;
  };
  /// Intersection of a ray's line with a triangle.
  struct Meeting {
    float t;
    float u;
    float v;
    Eigen::Vector3f normal;  // not of length 1
  };

  void add_triangles(const TriangleSource& triangle_scene);
  void add_patch(const TraceableInstance& placed, const TerrainPatch& patch);
  static void measure(Part& part, Triangle& triangle);
  void attach(Part& part, bool careful);
  std::pair<const Part&, const Triangle&> find(std::uint32_t triangle) const {
    const Part& part = parts_[triangle >> kPartBit];
    return {part, part.triangles[triangle & ((1u << kPartBit) - 1)]};
  }
  static Meeting meeting(const Part& part, const Triangle& triangle, const Met& met);
  static void cull_conservatively_hits(const RTCFilterFunctionNArguments* args);
  static void cull_conservatively_shadows(const RTCFilterFunctionNArguments* args);
  void fill(const Part& part, const Triangle& triangle, const Meeting& meets,
            const Eigen::Vector3f& direction, const Eigen::Vector3f& at,
            SurfaceInteraction& point) const;
  template <typename Keep>
  static void filter(const RTCFilterFunctionNArguments* args, const Keep& keep);

  const std::uint64_t number_;
  const Eigen::Vector3d origin_W_;
  const std::uint64_t time_;
  std::vector<Surface> surfaces_;
  Part parts_[2];  // hit by all rays; to be tested
  RTCSceneTy* scene_;
};

}  // namespace ardee::raycast
