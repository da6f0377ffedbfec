// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "ardee_sim/simulation/simulation.h"
#include "bench/triangle_soup.h"

namespace ardee::bench {

/// All that stands in a simulation without moving.
std::vector<Placement> scenery(const Simulation& simulation);

/// A scenery given to Embree as its own triangles and instances, to race the engine's rays against.
class EmbreeReference {
 public:
  /// One BVH over the triangles of all that stands within `radius_m` of `center`.
  static EmbreeReference flat(const std::vector<Placement>& scenery, const Eigen::Vector2d& center,
                              double radius_m);
  /// As the engine divides it: triangles within `near_m` of `center`, an instance each for the
  /// rest. Ground within `radius_m` is triangles.
  static EmbreeReference divided(const std::vector<Placement>& scenery,
                                 const Eigen::Vector2d& center, double near_m, double radius_m);
  ~EmbreeReference();
  EmbreeReference(EmbreeReference&& other) noexcept;

  std::size_t triangle_count() const { return triangle_count_; }
  /// Distance to the nearest hit, or +inf.
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
