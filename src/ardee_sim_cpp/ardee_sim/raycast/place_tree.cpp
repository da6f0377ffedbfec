// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/place_tree.h"

#include <algorithm>

namespace ardee::raycast {
namespace {

/// Margin against rounding where a ray enters and leaves the bounds of all places.
constexpr double kEndMargin_m = 1e-3;

}  // namespace

void PlaceTree::clear() {
  scene_.reset();
  places_.clear();
  boxes_.clear();
  bounds_W_ = Bounds{};
}

void PlaceTree::build(std::vector<const TraceableInstance*> places, BuildQuality quality,
                      double room_m) {
  clear();
  if (places.empty()) return;
  places_ = std::move(places);
  for (const TraceableInstance* placed : places_) bounds_W_.add(placed->bounds_W().grown(room_m));
  origin_W_ = bounds_W_.center();
  const double extent = bounds_W_.radius();
  boxes_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Bounds box = places_[i]->bounds_W().grown(room_m);
    box.lower -= origin_W_;
    box.upper -= origin_W_;
    round_outwards(box, extent, boxes_[i].lower, boxes_[i].upper);
  }
  scene_ = std::make_unique<EmbreeScene>(
      boxes_.size(),
      [this](std::size_t place, float* lower, float* upper) {
        std::copy_n(boxes_[place].lower, 3, lower);
        std::copy_n(boxes_[place].upper, 3, upper);
      },
      &intersect_place, this, quality);
}

void PlaceTree::intersect(RayQuery queries[kPacketRays], const double t_low[kPacketRays]) const {
  if (scene_ == nullptr) return;
  const Eigen::Vector3d half_size = 0.5 * (bounds_W_.upper - bounds_W_.lower);
  RaySegment passages[kPacketRays];
  for (int i = 0; i < kPacketRays; ++i) {
    if (!(t_low[i] <= queries[i].reach())) continue;
    // Only the part of the ray within the bounds is traced, so that floats are of the places' size
    // wherever the sensor is.
    const Ray& ray_W = queries[i].ray_W();
    passages[i].ray = {ray_W.origin - origin_W_, ray_W.direction};
    RayInterval chord;
    if (!intersect_box(passages[i].ray, half_size, chord)) continue;
    passages[i].t_low = std::max(t_low[i], chord.t_in - kEndMargin_m);
    passages[i].t_high = std::min(queries[i].reach(), chord.t_out + kEndMargin_m);
  }
  traverse_packet(scene_->get(), queries, passages);
}

void PlaceTree::intersect_place(const RTCIntersectFunctionNArguments* args) {
  const auto& tree = *static_cast<const PlaceTree*>(args->geometryUserPtr);
  const TraceableInstance& placed = *tree.places_[args->primID];
  for_each_ray(args, [&](RayQuery& query, RTCRayN*, unsigned, double t_shift) {
    query.intersect_traceable(placed, t_shift);
    return true;
  });
}

}  // namespace ardee::raycast
