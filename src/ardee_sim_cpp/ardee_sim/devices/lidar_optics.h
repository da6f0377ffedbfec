// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/raycast/ray_scene.h"

namespace ardee::devices {

/// What a lidar's light does on its way; the defaults are those of an ideal one.
///
/// The power that comes back from a surface which fills the beam is proportional to
/// reflectivity * cos(incidence) / range^2 (the laser range equation for a Lambertian target wider
/// than the beam; nominal). A surface that fills part of the beam sends back that part.
struct LidarOptics {
  /// Plain: the surface's laser_retro, else the cosine of incidence. Lambert: intensity_scale *
  /// reflectivity * cos(incidence) * share of the beam, the power freed from its 1 / range^2.
  enum class Intensity { kPlain, kLambert };
  enum class ReturnMode { kStrongest, kFirst };
  /// Where a beam's footprint is sampled: in those beams in which two surfaces become one return,
  /// as far as their neighbours tell, or in all of them.
  enum class SubRaysAt { kMixing, kEverywhere };

  Intensity intensity = Intensity::kPlain;
  double intensity_scale = 1.0;
  double reflectivity_range_m =
      0.0;                      // where a 10 % target, met squarely, is just seen; 0: no limit
  double divergence_rad = 0.0;  // full angle of the beam
  int sub_rays = 1;             // that sample its footprint evenly; 1: its axis alone
  SubRaysAt sub_rays_at = SubRaysAt::kMixing;
  double pulse_length_m = 0.3;  // returns less than this apart are one (2 ns; nominal)
  ReturnMode return_mode = ReturnMode::kStrongest;
};

/// The keys intensityModel, intensityScale, reflectivityRange, beamDivergence, subRays,
/// subRaysAt, pulseLength, returnMode.
LidarOptics read_lidar_optics(Parameters& parameters);

/// What a beam brings back. Ranges by REP 117: +inf nothing, -inf nearer than the minimum.
struct BeamEcho {
  float range_m = 0.0f;
  float intensity = 0.0f;
  std::uint32_t label = 0;
};

/// Directions of all sub-rays, those of a beam side by side. They stand for equal areas: the first
/// is the beam's axis, the others lie about it on a sunflower (Vogel 1979) turned by an angle of
/// the beam's own.
raycast::RayPattern spread_beams(const std::vector<Eigen::Vector3f>& axes_S,
                                 const LidarOptics& optics);

/// Makes an echo of what the sub-rays of a beam have met.
class ReturnModel {
 public:
  ReturnModel(const LidarOptics& optics, double range_min_m);

  /// `hits` and `cosines` (of incidence) are those of `count` rays that sample the beam: its axis
  /// alone, or its sub-rays.
  BeamEcho make(const raycast::RayHit* hits, const float* cosines, int count);

 private:
  struct Return {
    float range_m;
    float cosine;
    double power;
    const raycast::RayHit* hit;
  };
  struct Pulse {
    const Return* first;
    const Return* last;
    double power;
  };

  double power(const raycast::RayHit& hit, float cosine) const;
  float intensity(const raycast::RayHit& hit, float cosine) const;
  BeamEcho single(const raycast::RayHit& hit, float cosine) const;
  Pulse choose_pulse() const;
  BeamEcho mix(const Pulse& pulse, int count) const;

  LidarOptics optics_;
  float range_min_m_;
  double least_power_ = 0.0;
  std::vector<Return> returns_;  // of the beam, by range
};

}  // namespace ardee::devices
