// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/raycast/ray_query.h"
#include "ardee_sim/raycast/surface_texel.h"

namespace ardee::raycast {

/// A placed body's part in a triangle scene: its triangles, and those patches of its terrains.
struct TriangleSource {
  const TraceableInstance* placed = nullptr;
  std::vector<std::uint32_t> patches;
  const std::uint64_t* moved_at = nullptr;  // not null: it may leave its place
};

/// The triangles of placed bodies as Embree takes them, in floats, with what a picture needs of
/// them: several times as quick as exact tests.
class TriangleScene {
 public:
  /// Coordinates are relative to `origin_W`. The bodies must outlive the scene. Those that have
  /// moved after `time` are not met.
  TriangleScene(const EmbreeDevice& device, const std::vector<TriangleSource>& bodies,
                const Eigen::Vector3d& origin_W, std::uint64_t time);
  ~TriangleScene();

  /// A ray in the scene's coordinates, and the triangle that it has met.
  struct Met {
    Eigen::Vector3f origin;
    Eigen::Vector3f direction;
    std::uint32_t triangle;  // triangle_of()
  };

  /// A triangle by one number, from those that Embree gives.
  static std::uint32_t triangle_of(std::uint32_t geometry, std::uint32_t primitive) {
    return geometry << kPartBit | primitive;
  }
  /// Finds what the rays of a block of a picture, which start at `eye`, meet first.
  void trace_primary(const Eigen::Vector3f& eye, PrimaryRayPacket& block) const;
  /// Finds the triangle that each ray of the packet meets first.
  void intersect(RayPacket& packet) const;
  /// Makes tfar negative for rays with something in their way.
  void find_shadows(RayPacket& packet) const;
  /// What a ray has met, worked out from the triangle alone, so that it does not depend on the
  /// processor's instructions. A mesh's point_S is left out.
  void fill(const Met& met, SurfaceInteraction& point) const;

  /// No other triangle scene of this process has the same.
  std::uint64_t number() const { return number_; }
  /// The texel where a ray has met this triangle scene.
  SurfaceTexel texel(const TexelRequest& request) const;
  /// As `fill`, of a texel's middle looked at along the normal; `at` is in the scene's coordinates.
  void fill(const SurfaceTexel& texel, Eigen::Vector3f& at, SurfaceInteraction& point) const;

  std::size_t bytes() const;

 private:
  static constexpr int kPartBit = 30;

  /// Of one placed body.
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
    TriangleTexels texels;  // its longest side is that from the first corner to the second
  };
  struct Vertex {
    Eigen::Vector3f normal{0, 0, 0};  // in the world; zero: that of the triangle
    Eigen::Vector2f uv{0, 0};
  };
  /// Triangles that each ray meets, and those that must be looked at: with holes, without a back,
  /// without a shadow, of models that may leave.
  struct Part {
    const TriangleScene* scene = nullptr;
    std::vector<Triangle> triangles;
    std::vector<Eigen::Vector3f> places;  // of the vertices
    std::vector<Vertex> vertices;
  };
  /// Where the line of a ray meets a triangle.
  struct Meeting {
    float t;
    float u;
    float v;
    Eigen::Vector3f normal;  // not of length 1
  };

  void add_triangles(const TriangleSource& triangle_scene);
  void add_patch(const TraceableInstance& placed, const TerrainPatch& patch);
  static void measure(Part& part, Triangle& triangle);
  void attach(const EmbreeDevice& device, Part& part, bool careful);
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
  Part parts_[2];  // met by all; to be looked at
  RTCSceneTy* scene_;
};

}  // namespace ardee::raycast
