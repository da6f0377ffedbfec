// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/lidar_optics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/core/rng.h"

namespace ardee::devices {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kGoldenAngle_rad = 2.39996322972865332;
/// Reflectivity of the target of <reflectivityRange>.
constexpr double kReferenceReflectivity = 0.1;
/// 99 % of a normal distribution lie above its mean less this many standard deviations.
constexpr double kNinetyNinePercent = 2.3263478740408408;
/// Least reflectivity and cosine: no surface absorbs all light or is perfectly smooth (nominal).
constexpr double kDarkest = 0.01;
constexpr double kLeastCosine = 1e-3;
constexpr double kLeastRange_m = 1e-3;

template <typename Choice>
Choice choose(Parameters& parameters, const char* key, const char* first_name, Choice first,
              const char* second_name, Choice second) {
  const std::string text = parameters.text(key, first_name);
  if (text == first_name) return first;
  if (text == second_name) return second;
  throw parameters.error(key,
                         "expected " + std::string(first_name) + " or " + std::string(second_name));
}

}  // namespace

LidarOptics read_lidar_optics(Parameters& parameters) {
  constexpr double kWidest_rad = 0.2;
  constexpr int kMostSubRays = 256;
  LidarOptics optics;
  optics.intensity = choose(parameters, "intensityModel", "plain", LidarOptics::Intensity::kPlain,
                            "lambert", LidarOptics::Intensity::kLambert);
  optics.intensity_scale =
      parameters.number("intensityScale", optics.intensity_scale, 0.0, limits::kMostFactor);
  optics.reflectivity_range_m =
      parameters.number("reflectivityRange", 0.0, 0.0, limits::kFarthest_m);
  optics.detection_noise = parameters.number("detectionNoise", 0.0, 0.0, 1.0);
  optics.divergence_rad = parameters.number("beamDivergence", 0.0, 0.0, kWidest_rad);
  optics.sub_rays = parameters.integer("subRays", 1, 1, kMostSubRays);
  optics.sub_rays_at = choose(parameters, "subRaysAt", "mixing", LidarOptics::SubRaysAt::kMixing,
                              "everywhere", LidarOptics::SubRaysAt::kEverywhere);
  optics.pulse_length_m = parameters.number("pulseLength", optics.pulse_length_m, 0.0, 1e3);
  optics.return_mode =
      choose(parameters, "returnMode", "strongest", LidarOptics::ReturnMode::kStrongest, "first",
             LidarOptics::ReturnMode::kFirst);
  return optics;
}

raycast::RayPattern spread_beams(const std::vector<Eigen::Vector3f>& axes_S,
                                 const LidarOptics& optics) {
  if (optics.sub_rays == 1) return {axes_S};
  const CounterRng turns(stream_key(0, "beam footprint"));
  raycast::RayPattern pattern;
  pattern.directions_S.reserve(axes_S.size() * static_cast<std::size_t>(optics.sub_rays));
  for (std::size_t beam = 0; beam < axes_S.size(); ++beam) {
    const Eigen::Vector3d axis = axes_S[beam].cast<double>().normalized();
    const Eigen::Vector3d across = axis.unitOrthogonal();
    const Eigen::Vector3d upwards = axis.cross(across);
    const double turn_rad = 2.0 * M_PI * turns.uniform(beam);
    pattern.directions_S.push_back(axes_S[beam]);
    for (int k = 1; k < optics.sub_rays; ++k) {
      const double off_axis_rad =
          0.5 * optics.divergence_rad * std::sqrt((k + 0.5) / optics.sub_rays);
      const double about_rad = turn_rad + k * kGoldenAngle_rad;
      const Eigen::Vector3d aside = std::cos(about_rad) * across + std::sin(about_rad) * upwards;
      pattern.directions_S.push_back(
          (std::cos(off_axis_rad) * axis + std::sin(off_axis_rad) * aside).cast<float>());
    }
  }
  return pattern;
}

ReturnModel::ReturnModel(const LidarOptics& optics, double range_min_m)
    : optics_(optics), range_min_m_(static_cast<float>(range_min_m)) {
  if (optics.reflectivity_range_m > 0.0) {
    threshold_ = kReferenceReflectivity / std::pow(optics.reflectivity_range_m, 2) /
                 (1.0 + kNinetyNinePercent * optics.detection_noise);
  }
}

double ReturnModel::power(const raycast::RayHit& hit, float cosine) const {
  const double range_m = std::max(static_cast<double>(hit.range_m), kLeastRange_m);
  return std::max(static_cast<double>(hit.reflectivity), kDarkest) *
         std::max(static_cast<double>(cosine), kLeastCosine) / (range_m * range_m);
}

float ReturnModel::intensity(const raycast::RayHit& hit, float cosine) const {
  if (optics_.intensity == LidarOptics::Intensity::kPlain) {
    return hit.laser_retro > 0.0f ? hit.laser_retro : cosine;
  }
  return static_cast<float>(optics_.intensity_scale) * hit.reflectivity * cosine;
}

BeamEcho ReturnModel::make(const raycast::RayHit* hits, const float* cosines, int count,
                           double noise) {
  least_power_ = threshold_ * (1.0 - optics_.detection_noise * noise);
  if (count == 1) return single(hits[0], cosines[0]);
  returns_.clear();
  for (int k = 0; k < count; ++k) {
    if (!std::isfinite(hits[k].range_m)) continue;
    returns_.push_back({hits[k].range_m, cosines[k], power(hits[k], cosines[k]) / count, &hits[k]});
  }
  std::stable_sort(returns_.begin(), returns_.end(),
                   [](const Return& a, const Return& b) { return a.range_m < b.range_m; });
  const Pulse pulse = choose_pulse();
  return pulse.first == nullptr ? BeamEcho{kInfinity, 0.0f, 0} : mix(pulse, count);
}

BeamEcho ReturnModel::single(const raycast::RayHit& hit, float cosine) const {
  if (hit.range_m < range_min_m_) return {-kInfinity, 0.0f, 0};
  const bool seen =
      std::isfinite(hit.range_m) && (least_power_ <= 0.0 || power(hit, cosine) >= least_power_);
  if (!seen) return {kInfinity, 0.0f, 0};
  return {hit.range_m, intensity(hit, cosine), hit.label, hit.entity};
}

/// Merges returns within a pulse's length of the nearest one; the next group begins beyond.
ReturnModel::Pulse ReturnModel::choose_pulse() const {
  Pulse best{nullptr, nullptr, 0.0};
  const Return* const end = returns_.data() + returns_.size();
  for (const Return* first = returns_.data(); first != end;) {
    const float reach_m = first->range_m + static_cast<float>(optics_.pulse_length_m);
    Pulse pulse{first, first, 0.0};
    for (; pulse.last != end && pulse.last->range_m <= reach_m; ++pulse.last) {
      pulse.power += pulse.last->power;
    }
    first = pulse.last;
    if (pulse.power < least_power_ || pulse.power <= best.power) continue;
    best = pulse;
    if (optics_.return_mode == LidarOptics::ReturnMode::kFirst) break;
  }
  return best;
}

BeamEcho ReturnModel::mix(const Pulse& pulse, int count) const {
  double range_m = 0.0;
  double plain = 0.0;
  double diffuse = 0.0;
  const Return* strongest = pulse.first;
  for (const Return* each = pulse.first; each != pulse.last; ++each) {
    const double weight = each->power / pulse.power;
    const auto brightness = static_cast<double>(intensity(*each->hit, each->cosine));
    range_m += weight * static_cast<double>(each->range_m);
    plain += weight * brightness;
    diffuse += brightness / count;
    if (each->power > strongest->power) strongest = each;
  }
  const auto mixed_m = static_cast<float>(range_m);
  if (mixed_m < range_min_m_) return {-kInfinity, 0.0f, 0};
  const bool is_plain = optics_.intensity == LidarOptics::Intensity::kPlain;
  return {mixed_m, static_cast<float>(is_plain ? plain : diffuse), strongest->hit->label,
          strongest->hit->entity};
}

}  // namespace ardee::devices
