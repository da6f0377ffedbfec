// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/lidar_beams.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ardee::devices {
namespace {

constexpr std::size_t kMostSubRays = std::size_t(1) << 23;
/// Beams whose axes are at most this many widths apart predict each other's footprints.
constexpr double kNeighbourWidths = 2.0;
/// A neighbour within this distance of the tangent plane is on one surface with the beam: less than
/// a lidar's noise (nominal).
constexpr float kSameSurface_m = 0.02f;

std::vector<Eigen::Vector3f> make_axes(const RayBlock& block) {
  std::vector<Eigen::Vector3f> axes_S;
  axes_S.reserve(block.rays());
  for (int row = 0; row < block.rows; ++row) {
    const double level = std::cos(block.elevation_rad(row));
    const double height = std::sin(block.elevation_rad(row));
    for (int column = 0; column < block.columns; ++column) {
      const double azimuth_rad = block.azimuth_rad(column);
      axes_S.emplace_back(static_cast<float>(level * std::cos(azimuth_rad)),
                          static_cast<float>(level * std::sin(azimuth_rad)),
                          static_cast<float>(height));
    }
  }
  return axes_S;
}

/// Whether two adjacent beams with hits at those points have hit two surfaces that one pulse cannot
/// separate.
bool mix(const raycast::RayHit& a, const Eigen::Vector3f& point_a_W, const raycast::RayHit& b,
         const Eigen::Vector3f& point_b_W, float pulse_length_m) {
  if (!(std::abs(a.range_m - b.range_m) <= pulse_length_m)) return false;  // NaN: neither has a hit
  const Eigen::Vector3f apart_W = point_b_W - point_a_W;
  return std::abs(apart_W.dot(a.normal_W)) > kSameSurface_m ||
         std::abs(apart_W.dot(b.normal_W)) > kSameSurface_m;
}

}  // namespace

/// The pose of each column, or one for all of them.
class LidarBeams::Poses {
 public:
  Poses(const Pose* first, int columns) : first_(first), columns_(columns) {}

  const Pose& of(std::size_t beam) const {
    return columns_ == 1 ? *first_ : first_[beam % static_cast<std::size_t>(columns_)];
  }

 private:
  const Pose* first_;
  int columns_;  // 1: one pose for all
};

LidarBeams::LidarBeams(const RayBlock& block, const LidarOptics& optics, bool look_through_near,
                       const Carrier& carrier)
    : columns_(block.columns),
      range_min_m_(block.range_min_m),
      range_max_m_(block.range_max_m),
      optics_(optics),
      look_through_near_(look_through_near),
      carrier_(carrier) {
  const std::size_t rays = block.rays() * static_cast<std::size_t>(optics.sub_rays);
  if (rays > kMostSubRays) {
    throw Error("found " + std::to_string(rays) + " rays with all sub-rays, expected up to " +
                std::to_string(kMostSubRays));
  }
  axes_.pattern.directions_S = make_axes(block);
  axes_.beams.resize(block.rays());
  std::iota(axes_.beams.begin(), axes_.beams.end(), 0u);
  if (optics.sub_rays == 1) return;
  footprints_.pattern = spread_beams(axes_.pattern.directions_S, optics);
  footprints_.beams = axes_.beams;
  footprints_.each = optics.sub_rays;
  mixing_.each = optics.sub_rays;
  about_.each = optics.sub_rays - 1;
  const double spacing_rad = std::abs(block.angle_increment_rad());
  if (spacing_rad <= 0.0 || spacing_rad > kNeighbourWidths * optics.divergence_rad) {
    optics_.sub_rays_at = LidarOptics::SubRaysAt::kEverywhere;
    return;
  }
  const double reach = std::ceil(0.5 * optics.divergence_rad / spacing_rad);
  mixing_reach_ = static_cast<std::size_t>(std::min(reach, static_cast<double>(columns_)));
}

raycast::SceneRay LidarBeams::ray(const Poses& X_WS, const Rays& rays, std::size_t i,
                                  double from_m) const {
  const Pose& pose = X_WS.of(rays.beam(i));
  const Eigen::Vector3d direction_S = rays.pattern.directions_S[i].cast<double>();
  const double reach_m = static_cast<double>(static_cast<float>(range_max_m_)) - from_m;
  return {pose * (from_m * direction_S), (pose.q * direction_S).normalized(), reach_m};
}

template <typename Cast>
void LidarBeams::look_beyond_minimum(const Poses& X_WS, const Rays& rays, const Cast& cast,
                                     std::vector<raycast::RayHit>& hits) const {
  const auto minimum_m = static_cast<float>(range_min_m_);
  std::vector<std::size_t> blocked;
  std::vector<raycast::SceneRay> again;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (!(hits[i].range_m < minimum_m)) continue;
    if (!look_through_near_ && hits[i].entity != carrier_.entity) continue;
    blocked.push_back(i);
    again.push_back(ray(X_WS, rays, i, range_min_m_));
  }
  if (blocked.empty()) return;
  std::vector<raycast::RayHit> beyond;
  cast(again, beyond);
  for (std::size_t k = 0; k < blocked.size(); ++k) {
    beyond[k].range_m += minimum_m;
    hits[blocked[k]] = beyond[k];
  }
}

template <typename Trace>
void LidarBeams::measure_by(const Trace& trace, const Poses& X_WS, const CounterRng& receiver,
                            std::vector<BeamEcho>& echoes) const {
  echoes.resize(count());
  const bool whole =
      !footprints_.beams.empty() && optics_.sub_rays_at == LidarOptics::SubRaysAt::kEverywhere;
  const Rays& first = whole ? footprints_ : axes_;
  trace(first, hits_);
  make_echoes(first, hits_, X_WS, receiver, echoes);
  if (whole || footprints_.beams.empty()) return;
  pick_mixing(X_WS);
  trace(about_, hits_about_);
  hits_mixing_.clear();
  auto about = hits_about_.cbegin();
  for (const std::uint32_t beam : mixing_.beams) {
    hits_mixing_.push_back(hits_[beam]);
    hits_mixing_.insert(hits_mixing_.end(), about, about + about_.each);
    about += about_.each;
  }
  make_echoes(mixing_, hits_mixing_, X_WS, receiver, echoes);
}

void LidarBeams::measure(const Pose& X_WS, const raycast::RayScene& scene,
                         const CounterRng& receiver, std::vector<BeamEcho>& echoes) const {
  const Poses pose(&X_WS, 1);
  const auto trace = [&](const Rays& rays, std::vector<raycast::RayHit>& hits) {
    scene.cast(X_WS, rays.pattern, static_cast<float>(range_max_m_), carrier_.entity, carrier_.link,
               hits);
    look_beyond_minimum(
        pose, rays,
        [&](const std::vector<raycast::SceneRay>& some, std::vector<raycast::RayHit>& beyond) {
          scene.cast(some, carrier_.entity, carrier_.link, beyond);
        },
        hits);
  };
  measure_by(trace, pose, receiver, echoes);
}

void LidarBeams::measure_moving(const std::vector<Pose>& X_WS, const raycast::RayScene& scene,
                                const CounterRng& receiver, std::vector<BeamEcho>& echoes) const {
  const Poses poses(X_WS.data(), columns_);
  const Poses pose_now(&X_WS.back(), 1);
  const auto cast_at_others = [&](const std::vector<raycast::SceneRay>& some,
                                  std::vector<raycast::RayHit>& hits) {
    scene.cast(some, carrier_.entity, raycast::kAllLinks, hits);
  };
  const auto cast_at_own = [&](const std::vector<raycast::SceneRay>& some,
                               std::vector<raycast::RayHit>& hits) {
    scene.cast_at_model(some, carrier_.entity, carrier_.link, hits);
  };
  const auto trace = [&](const Rays& rays, std::vector<raycast::RayHit>& hits) {
    const std::size_t count = rays.pattern.directions_S.size();
    std::vector<raycast::SceneRay> way;
    way.reserve(count);
    for (std::size_t i = 0; i < count; ++i) way.push_back(ray(poses, rays, i, 0.0));
    cast_at_others(way, hits);
    look_beyond_minimum(poses, rays, cast_at_others, hits);
    for (std::size_t i = 0; i < count; ++i) way[i] = ray(pose_now, rays, i, 0.0);
    std::vector<raycast::RayHit> own;
    cast_at_own(way, own);
    look_beyond_minimum(pose_now, rays, cast_at_own, own);
    for (std::size_t i = 0; i < count; ++i) {
      if (!(own[i].range_m < hits[i].range_m)) continue;
      hits[i] = own[i];
      // The present normal, turned into the frame of the column's own time.
      const Pose& then = poses.of(rays.beam(i));
      hits[i].normal_W =
          (then.q * (X_WS.back().q.conjugate() * own[i].normal_W.cast<double>())).cast<float>();
    }
  };
  measure_by(trace, poses, receiver, echoes);
}

void LidarBeams::pick_mixing(const Poses& X_WS) const {
  const Eigen::Vector3d& origin_W = X_WS.of(0).p;
  points_W_.resize(count());
  for (std::size_t beam = 0; beam < count(); ++beam) {
    const Pose& pose = X_WS.of(beam);
    points_W_[beam] = pose.q.cast<float>() * (hits_[beam].range_m * axis_S(beam)) +
                      (pose.p - origin_W).cast<float>();
  }
  for (Rays* rays : {&mixing_, &about_}) {
    rays->beams.clear();
    rays->pattern.directions_S.clear();
  }
  const std::vector<Eigen::Vector3f>& all_S = footprints_.pattern.directions_S;
  const auto columns = static_cast<std::size_t>(columns_);
  const auto each = static_cast<std::size_t>(mixing_.each);
  const auto pulse_length_m = static_cast<float>(optics_.pulse_length_m);
  std::size_t next = 0;  // all beams before it are decided
  for (std::size_t beam = 0; beam + 1 < count(); ++beam) {
    const std::size_t row_end = beam - beam % columns + columns;
    if (beam + 1 == row_end ||
        !mix(hits_[beam], points_W_[beam], hits_[beam + 1], points_W_[beam + 1], pulse_length_m)) {
      continue;
    }
    next = std::max({next, row_end - columns, beam + 1 - std::min(beam + 1, mixing_reach_)});
    for (; next < std::min(row_end, beam + 1 + mixing_reach_); ++next) {
      const auto axis = all_S.begin() + static_cast<std::ptrdiff_t>(next * each);
      for (Rays* rays : {&mixing_, &about_}) {
        rays->beams.push_back(static_cast<std::uint32_t>(next));
        auto& some_S = rays->pattern.directions_S;
        some_S.insert(some_S.end(), axis + mixing_.each - rays->each, axis + mixing_.each);
      }
    }
  }
}

void LidarBeams::make_echoes(const Rays& rays, const std::vector<raycast::RayHit>& hits,
                             const Poses& X_WS, const CounterRng& receiver,
                             std::vector<BeamEcho>& echoes) const {
  ReturnModel maker(optics_, range_min_m_);
  const auto each = static_cast<std::size_t>(rays.each);
  std::vector<float> cosines(each);
  for (std::size_t k = 0; k < rays.beams.size(); ++k) {
    const std::size_t first = k * each;
    const Eigen::Quaternionf q = X_WS.of(rays.beams[k]).q.cast<float>();
    for (std::size_t i = 0; i < each; ++i) {
      const Eigen::Vector3f direction_W = q * rays.pattern.directions_S[first + i];
      cosines[i] = std::abs(hits[first + i].normal_W.dot(direction_W));
    }
    const double noise = optics_.detection_noise > 0.0 ? receiver.normal(rays.beams[k]) : 0.0;
    echoes[rays.beams[k]] = maker.make(&hits[first], cosines.data(), rays.each, noise);
  }
}

}  // namespace ardee::devices
