// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/raycast/ray_scene.h"

namespace ardee::devices {

/// Optical model of a lidar's beams; the defaults are those of an ideal lidar.
///
/// The power returned by a surface that fills the beam is proportional to reflectivity *
/// cos(incidence) / range^2 (the laser range equation for a Lambertian target wider than the beam;
/// nominal). A surface that fills part of the beam returns that part. A return is detected if its
/// power and the receiver's noise, which is normal, exceed the receiver's threshold.
struct LidarOptics {
  /// Plain: the surface's laser_retro, else the cosine of incidence. Lambert: intensity_scale *
  /// reflectivity * cos(incidence) * share of the beam, the power without its 1 / range^2.
  enum class Intensity { kPlain, kLambert };
  enum class ReturnMode { kStrongest, kFirst };
  /// Beams whose footprint is sampled: only those in which, by their neighbours, two surfaces merge
  /// into one return, or all.
  enum class SubRaysAt { kMixing, kEverywhere };

  Intensity intensity = Intensity::kPlain;
  double intensity_scale = 1.0;
  double reflectivity_range_m =
      0.0;  // to which a 10 % target at normal incidence is detected, see detection_noise; 0: any
  /// SD of the receiver's noise as a share of its threshold. At reflectivity_range_m 99 % of the
  /// pulses are detected; 0: all up to there, and none beyond.
  double detection_noise = 0.0;
  double divergence_rad = 0.0;  // full angle of the beam
  int sub_rays = 1;             // sample its footprint evenly; 1: its axis alone
  SubRaysAt sub_rays_at = SubRaysAt::kMixing;
  double pulse_length_m = 0.3;  // returns less than this apart are one (2 ns; nominal)
  ReturnMode return_mode = ReturnMode::kStrongest;
};

/// The keys intensityModel, intensityScale, reflectivityRange, detectionNoise, beamDivergence,
/// subRays, subRaysAt, pulseLength, returnMode.
LidarOptics read_lidar_optics(Parameters& parameters);

/// Return of a beam. Ranges by REP 117: +inf no return, -inf nearer than the minimum.
struct BeamEcho {
  float range_m = 0.0f;
  float intensity = 0.0f;
  std::uint32_t label = 0;
  std::uint32_t entity = raycast::kNoEntity;
};

/// Directions of all sub-rays, those of a beam consecutively. They stand for equal areas: the first
/// is the beam's axis, the others lie about it on a sunflower (Vogel 1979) turned by an angle that
/// differs from beam to beam.
raycast::RayPattern spread_beams(const std::vector<Eigen::Vector3f>& axes_S,
                                 const LidarOptics& optics);

/// Makes an echo from the hits of a beam's sub-rays.
class ReturnModel {
 public:
  ReturnModel(const LidarOptics& optics, double range_min_m);

  /// `hits` and `cosines` (of incidence) are those of `count` rays that sample the beam: its axis
  /// alone, or its sub-rays; `noise` is the receiver's, a standard normal.
  BeamEcho make(const raycast::RayHit* hits, const float* cosines, int count, double noise);

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
  double threshold_ = 0.0;
  double least_power_ = 0.0;     // that is detected in the present beam
  std::vector<Return> returns_;  // of the beam, by range
};

}  // namespace ardee::devices
