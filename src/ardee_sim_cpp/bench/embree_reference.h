// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "ardee_sim/simulation/simulation.h"
#include "bench/triangle_soup.h"

namespace ardee::bench {

/// Returns all placements of a simulation's scenery.
std::vector<Placement> scenery(const Simulation& simulation);

/// Scenery as Embree's own triangles and instances, to compare with the engine's rays.
class EmbreeReference {
 public:
  /// Builds one BVH over the triangles of all bodies within `radius_m` of `center`.
  static EmbreeReference flat(const std::vector<Placement>& scenery, const Eigen::Vector2d& center,
                              double radius_m);
  /// Divides the scenery as the engine does: triangles within `near_m` of `center`, and one
  /// instance for each other body. Ground within `radius_m` is triangles.
  static EmbreeReference divided(const std::vector<Placement>& scenery,
                                 const Eigen::Vector2d& center, double near_m, double radius_m);
  ~EmbreeReference();
  EmbreeReference(EmbreeReference&& other) noexcept;

  std::size_t triangle_count() const { return triangle_count_; }
  /// Returns the distance to the nearest hit, or +inf.
  float cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
             float max_range_m) const;

 private:
  EmbreeReference();
  void add_triangles(RTCScene scene, const TriangleSoup& soup);
  void add_instance(RTCScene plant, const Placement& placement);
  void commit();

  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
  std::size_t triangle_count_ = 0;
};

}  // namespace ardee::bench
