// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/devices/lidar_optics.h"
#include "ardee_sim/devices/ray_block.h"
#include "ardee_sim/raycast/ray_scene.h"

namespace ardee::devices {

/// The rays of a sensor with a <ray> block and what they bring back: the one ray loop of lidars,
/// sonars and the like. Beams are numbered row by row: row * columns + column.
class LidarBeams {
 public:
  /// Where the rays start from: a link of a model in the scene. The robot's own bodies nearer than
  /// the minimum, such as the sensor's housing, are in nobody's way.
  struct Carrier {
    std::uint32_t entity = raycast::kNoEntity;
    std::uint32_t link = 0;
  };

  /// look_through_near: Gazebo's way, what is nearer than the minimum is not seen at all.
  LidarBeams(const RayBlock& block, const LidarOptics& optics, bool look_through_near,
             const Carrier& carrier);

  std::size_t count() const { return axes_.beams.size(); }
  const Eigen::Vector3f& axis_S(std::size_t beam) const { return axes_.pattern.directions_S[beam]; }

  /// What all beams bring back to X_WS: a pure function of the scene.
  void measure(const Pose& X_WS, const raycast::RayScene& scene,
               std::vector<BeamEcho>& echoes) const;
  /// The same for a sensor that moves while it scans: the beams of column k leave from X_WS[k], the
  /// last one's pose is that of now. Own bodies are met where they are as the sensor sees them now.
  void measure_moving(const std::vector<Pose>& X_WS, const raycast::RayScene& scene,
                      std::vector<BeamEcho>& echoes) const;

 private:
  /// Rays of some beams, those of a beam side by side.
  struct Rays {
    raycast::RayPattern pattern;
    std::vector<std::uint32_t> beams;
    int each = 1;  // of a beam

    std::size_t beam(std::size_t ray) const { return beams[ray / static_cast<std::size_t>(each)]; }
  };
  class Poses;

  raycast::SceneRay ray(const Poses& X_WS, const Rays& rays, std::size_t i, double from_m) const;
  template <typename Cast>
  void look_beyond_minimum(const Poses& X_WS, const Rays& rays, const Cast& cast,
                           std::vector<raycast::RayHit>& hits) const;
  /// `trace(rays, hits)` finds what rays meet.
  template <typename Trace>
  void measure_by(const Trace& trace, const Poses& X_WS, std::vector<BeamEcho>& echoes) const;
  void make_echoes(const Rays& rays, const std::vector<raycast::RayHit>& hits, const Poses& X_WS,
                   std::vector<BeamEcho>& echoes) const;
  /// Into mixing_ and about_: the beams beside which, by the hits of the axes, another surface
  /// begins, less than a pulse's length nearer or farther.
  void pick_mixing(const Poses& X_WS) const;

  int columns_;
  double range_min_m_;
  double range_max_m_;
  LidarOptics optics_;
  bool look_through_near_;
  Carrier carrier_;
  Rays axes_;
  Rays footprints_;  // all sub-rays of all beams, the axis first; empty where the axes do
  std::size_t mixing_reach_ =
      1;  // so many beams to each side of an edge may have it in their footprint
  // Scratch, to spare allocations a scan.
  mutable std::vector<raycast::RayHit> hits_;
  mutable std::vector<raycast::RayHit> hits_about_;
  mutable std::vector<raycast::RayHit> hits_mixing_;
  mutable std::vector<Eigen::Vector3f> points_W_;
  mutable Rays mixing_;  // all sub-rays of the beams that mix
  mutable Rays about_;   // the same without the axes, which have been traced
};

}  // namespace ardee::devices
