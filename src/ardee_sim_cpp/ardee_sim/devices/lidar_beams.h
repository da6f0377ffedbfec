// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/devices/lidar_optics.h"
#include "ardee_sim/devices/ray_block.h"
#include "ardee_sim/raycast/ray_scene.h"

namespace ardee {

/// The rays of a sensor with a <ray> block and what they bring back: the one ray loop of lidars,
/// sonars and the like. Beams are numbered row by row: row * columns + column.
class LidarBeams {
 public:
  /// Where the rays start from: a link of a model in the scene. The robot's own bodies nearer than
  /// the minimum, such as the sensor's housing, are in nobody's way.
  struct Carrier {
    std::uint32_t entity = kNoEntity;
    std::uint32_t link = 0;
  };

  /// look_through_near: Gazebo's way, what is nearer than the minimum is not seen at all.
  LidarBeams(const RayBlock& block, const LidarOptics& optics, bool look_through_near,
             const Carrier& carrier);

  std::size_t count() const { return axes_S_.size(); }
  const Eigen::Vector3f& axis_S(std::size_t beam) const { return axes_S_[beam]; }

  /// What all beams bring back to X_WS: a pure function of the scene.
  void measure(const Pose& X_WS, const RayScene& scene, std::vector<BeamEcho>& echoes) const;
  /// The same for a sensor that moves while it scans: the beams of column k leave from X_WS[k], the
  /// last one's pose is that of now. Own bodies are met where they are as the sensor sees them now.
  void measure_moving(const std::vector<Pose>& X_WS, const RayScene& scene,
                      std::vector<BeamEcho>& echoes) const;

 private:
  struct Poses;

  SceneRay ray(const Pose& X_WS, std::size_t sub_ray, double from_m) const;
  template <typename Cast>
  void look_beyond_minimum(const Poses& X_WS, const Cast& cast, std::vector<RayHit>& hits) const;
  void make_echoes(const Poses& X_WS, std::vector<BeamEcho>& echoes) const;

  int columns_;
  double range_min_m_;
  double range_max_m_;
  LidarOptics optics_;
  bool look_through_near_;
  Carrier carrier_;
  std::vector<Eigen::Vector3f> axes_S_;
  RayPattern pattern_;
  mutable std::vector<RayHit> hits_;  // scratch, to spare an allocation a scan
};

}  // namespace ardee
