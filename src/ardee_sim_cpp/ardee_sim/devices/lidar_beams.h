// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/devices/lidar_optics.h"
#include "ardee_sim/devices/ray_block.h"
#include "ardee_sim/raycast/ray_scene.h"

namespace ardee::devices {

/// The rays of a sensor with a <ray> block and their returns: the one ray loop of lidars, sonars
/// and the like. Beams are numbered row by row: row * columns + column.
class LidarBeams {
 public:
  /// Link of a model in the scene from which the rays start. The robot's own bodies nearer than the
  /// minimum, such as the sensor's housing, do not block rays.
  struct Carrier {
    std::uint32_t entity = raycast::kNoEntity;
    std::uint32_t link = 0;
  };

  /// With `look_through_near` rays pass through surfaces nearer than the minimum, as in Gazebo.
  LidarBeams(const RayBlock& block, const LidarOptics& optics, bool look_through_near,
             const Carrier& carrier);

  std::size_t count() const { return axes_.beams.size(); }
  const Eigen::Vector3f& axis_S(std::size_t beam) const { return axes_.pattern.directions_S[beam]; }

  /// Measures the returns of all beams at X_WS: a pure function of the scene and of the receiver's
  /// noise, of which beam i uses counter i.
  void measure(const Pose& X_WS, const raycast::RayScene& scene, const CounterRng& receiver,
               std::vector<BeamEcho>& echoes) const;
  /// Measures the returns of a sensor that moves while it scans: the beams of column k leave from
  /// X_WS[k], and the last pose is the present one. The robot's own bodies keep their present poses
  /// relative to the sensor.
  void measure_moving(const std::vector<Pose>& X_WS, const raycast::RayScene& scene,
                      const CounterRng& receiver, std::vector<BeamEcho>& echoes) const;

 private:
  /// Rays of some beams, those of a beam consecutively.
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
  /// `trace(rays, hits)` finds the hits of rays.
  template <typename Trace>
  void measure_by(const Trace& trace, const Poses& X_WS, const CounterRng& receiver,
                  std::vector<BeamEcho>& echoes) const;
  void make_echoes(const Rays& rays, const std::vector<raycast::RayHit>& hits, const Poses& X_WS,
                   const CounterRng& receiver, std::vector<BeamEcho>& echoes) const;
  /// Fills mixing_ and about_ with the beams beside which, by the hits of the axes, another surface
  /// begins, less than a pulse's length nearer or farther.
  void pick_mixing(const Poses& X_WS) const;

  int columns_;
  double range_min_m_;
  double range_max_m_;
  LidarOptics optics_;
  bool look_through_near_;
  Carrier carrier_;
  Rays axes_;
  Rays footprints_;  // all sub-rays of all beams, the axis first; empty if the axes suffice
  std::size_t mixing_reach_ = 1;  // number of beams on each side of an edge that may contain it
  // Scratch buffers, to avoid allocations per scan.
  mutable std::vector<raycast::RayHit> hits_;
  mutable std::vector<raycast::RayHit> hits_about_;
  mutable std::vector<raycast::RayHit> hits_mixing_;
  mutable std::vector<Eigen::Vector3f> points_W_;
  mutable Rays mixing_;  // all sub-rays of the beams that mix
  mutable Rays about_;   // those sub-rays without the axes, which have been traced
};

}  // namespace ardee::devices
