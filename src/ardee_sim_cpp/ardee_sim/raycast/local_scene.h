// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/fixed_scenery.h"
#include "ardee_sim/raycast/still_instance.h"
#include "ardee_sim/raycast/triangle_scene.h"

namespace ardee::raycast {

/// Primitives of all scenery in a square of ground, side by side in one Embree scene: a ray that
/// starts in the square needs no other scene until it leaves it. For pictures, models at rest count
/// as scenery until they move.
class LocalScene {
 public:
  /// Memory of one entry with its share of Embree's tree (measured: README).
  static constexpr std::size_t kBytesPerEntry = 120;
  /// Memory of a triangle of the triangle scene with its share of Embree's tree (nominal).
  static constexpr std::size_t kBytesPerTriangle = 140;

  /// Makes the square smaller than asked for if its content exceeds the budget.
  LocalScene(std::shared_ptr<const FixedScenery> scenery, const StillInstances& still,
             const LocalSceneRequest& request);

  bool holds_all() const { return holds_all_; }
  const Eigen::Vector2d& center_W() const { return center_W_; }
  double half_size_m() const { return half_size_m_; }
  /// Returns how far inside the square a point lies (negative: outside) [m].
  double depth_m(const Eigen::Vector3d& point_W) const {
    return half_size_m_ - (point_W.head<2>() - center_W_).cwiseAbs().maxCoeff();
  }
  bool touches(const Bounds& box_W) const;
  bool holds(const Bounds& box_W) const;
  /// Returns t where a ray from inside leaves the square.
  double border_t(const Ray& ray_W) const;
  /// Does the same; infinity if there is no other scenery.
  double exit_t(const Ray& ray_W) const;
  /// Finds all hits, each query up to its t_high (negative: not at all).
  void intersect(RayQuery queries[kPacketRays], const double t_high[kPacketRays]) const;

  bool is_for_pictures() const { return for_pictures_; }
  /// Triangles relative to origin_W(); nullptr if they exceed the budget.
  const TriangleScene* triangle_scene() const { return triangle_scene_.get(); }
  const Eigen::Vector3d& origin_W() const { return origin_W_; }
  /// Returns whether the triangle scene leaves something out; intersect_rest() finds it.
  bool has_rest() const { return rest_scene_ != nullptr; }
  void intersect_rest(RayQuery queries[kPacketRays], const double t_high[kPacketRays]) const;
  /// Models at rest that a scene for pictures contains.
  const std::vector<StillInstance>& still() const { return still_; }

  std::size_t bytes() const;
  std::size_t triangles() const { return triangles_; }

 private:
  struct alignas(64) Frame {
    BlockPlace place;
    const TraceableInstance* placed;
    const std::uint64_t* moved_at;  // null: it does not move
  };
  struct alignas(32) Entry {
    float center[3];  // the primitive's centre, relative to origin_W_
    std::uint32_t frame;
    const TriangleBlock* block;  // null: another kind of primitive
    std::uint32_t primitive;
  };

  /// Entries that are not in the triangle scene.
  struct Rest {
    const LocalScene* local;
    std::vector<std::uint32_t> entries;
  };

  /// Returns false if no query has to be traced.
  bool find_segments(const RayQuery queries[kPacketRays], const double t_high[kPacketRays],
                     RaySegment passages[kPacketRays]) const;
  static void intersect_rest_entry(const RTCIntersectFunctionNArguments* args);
  static void intersect_entry(const RTCIntersectFunctionNArguments* args);
  void choose_size(const StillInstances& still, const LocalSceneBudget& budget);
  void take_still(const StillInstances& still);
  void add_triangle_scene(std::size_t budget_bytes);
  void add(const TraceableInstance& placed, const std::uint64_t* moved_at = nullptr);
  void entry_bounds(std::size_t index, float* lower, float* upper) const;

  std::shared_ptr<const FixedScenery> scenery_;  // owns the places
  Eigen::Vector2d center_W_;
  double half_size_m_;
  bool holds_all_ = false;
  Eigen::Vector3d origin_W_;
  double half_height_m_ = 0.0;
  double extent_m_ = 0.0;  // largest coordinate relative to origin_W_
  float slack_m_ = 0.0f;
  std::size_t triangles_ = 0;
  std::vector<StillInstance> still_;
  std::vector<Frame> frames_;
  std::vector<Entry> entries_;  // scenery, then models at rest
  std::unique_ptr<EmbreeScene> scene_;
  bool for_pictures_;
  std::unique_ptr<TriangleScene> triangle_scene_;
  Rest rest_;
  std::unique_ptr<EmbreeScene> rest_scene_;
  const std::uint64_t time_;  // when the models at rest were taken
};

}  // namespace ardee::raycast
