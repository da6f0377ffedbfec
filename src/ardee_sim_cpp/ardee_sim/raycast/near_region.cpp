// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/near_region.h"

#include <algorithm>
#include <cmath>

namespace ardee {
namespace {

/// Of one entry with its share of Embree's tree (measured: README).
constexpr std::size_t kBytesPerEntry = 120;
/// Of a triangle of the draft with its share of Embree's tree (nominal).
constexpr std::size_t kBytesPerDraftTriangle = 140;
/// Bodies wider than this are taken in piece by piece.
constexpr double kWide_m = 4.0;
constexpr double kEdge_m = 1e-2;
constexpr double kShrink = 0.8;
constexpr double kSmallest_m = 0.5;
constexpr double kFloatSlack = 2e-6;

}  // namespace

NearRegion::NearRegion(const EmbreeDevice& device, const SceneryStore& store,
                       const Eigen::Vector2d& center_W, double half_size_m,
                       std::size_t budget_bytes)
    : center_W_(center_W), half_size_m_(half_size_m) {
  choose_size(store, budget_bytes);
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(half_size_m_ + kEdge_m);
  const Bounds& all = store.bounds_W();
  origin_W_ << center_W_, all.empty() ? 0.0 : all.center().z();
  std::size_t places = 0;
  store.find(center_W_ - half, center_W_ + half, [&](std::size_t index) {
    const PlacedBody& placed = *store.places()[index];
    ++places;
    add(placed);
  });
  const bool inside = !all.empty() && (all.lower.head<2>() - center_W_ + half).minCoeff() >= 0.0 &&
                      (center_W_ + half - all.upper.head<2>()).minCoeff() >= 0.0;
  holds_all_ = places == store.places().size() && inside;
  if (entries_.empty()) return;
  half_height_m_ = 0.5 * (all.upper - all.lower).z() + kEdge_m;
  extent_m_ = 2.0 * (half_size_m_ + half_height_m_);
  slack_m_ = static_cast<float>(kFloatSlack * extent_m_);
  scene_ = std::make_unique<EmbreeScene>(
      device, entries_.size(),
      [this](std::size_t index, float* lower, float* upper) { entry_bounds(index, lower, upper); },
      &meet_entry, this, BuildQuality::kMedium);
}

void NearRegion::choose_size(const SceneryStore& store, std::size_t budget_bytes) {
  for (; half_size_m_ > kSmallest_m; half_size_m_ *= kShrink) {
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(half_size_m_);
    std::size_t entries = 0;
    store.find(center_W_ - half, center_W_ + half,
               [&](std::size_t index) { entries += store.places()[index]->body->pieces.size(); });
    if (entries * kBytesPerEntry <= budget_bytes) return;
  }
}

void NearRegion::add(const PlacedBody& placed) {
  const Body& body = *placed.body;
  const Eigen::Matrix3d R_WB = placed.q.toRotationMatrix();
  const Eigen::Matrix3d m = R_WB.transpose() / placed.scale;
  Frame frame;
  frame.place.scale = static_cast<float>(placed.scale);
  frame.placed = &placed;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) frame.place.m[i][j] = static_cast<float>(m(i, j));
  }
  const auto frame_index = static_cast<std::uint32_t>(frames_.size());
  frames_.push_back(frame);
  const bool wide = body.bounds.radius() * placed.scale > kWide_m;
  const double reach = half_size_m_ + kEdge_m;
  for (std::uint32_t k = 0; k < body.pieces.size(); ++k) {
    const Bounds& box_B = body.piece_bounds[k];
    if (wide) {
      const Bounds box = box_B.transformed(R_WB * placed.scale, placed.p);
      const bool apart = (box.lower.head<2>() - center_W_).maxCoeff() > reach ||
                         (center_W_ - box.upper.head<2>()).maxCoeff() > reach;
      if (apart) continue;
    }
    const Eigen::Vector3d center = placed.p + R_WB * (placed.scale * box_B.center()) - origin_W_;
    Entry entry{};
    for (int i = 0; i < 3; ++i) entry.center[i] = static_cast<float>(center[i]);
    entry.frame = frame_index;
    entry.piece = k;
    if (body.pieces[k].kind == Piece::Kind::kBlock) {
      entry.block = &body.blocks[body.pieces[k].index];
      triangles_ += entry.block->count;
    }
    entries_.push_back(entry);
  }
}

void NearRegion::entry_bounds(std::size_t index, float* lower, float* upper) const {
  const Entry& entry = entries_[index];
  const PlacedBody& placed = *frames_[entry.frame].placed;
  if (entry.block == nullptr) {
    Bounds box = placed.body->piece_bounds[entry.piece].transformed(
        placed.q.toRotationMatrix() * placed.scale, placed.p - origin_W_);
    round_outwards(box, extent_m_ + box.radius(), lower, upper);
    return;
  }
  // m is R_BW / scale: its transpose times the scale squared turns the block into the world.
  const Frame& frame = frames_[entry.frame];
  const float square = frame.place.scale * frame.place.scale;
  float turn[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) turn[i][j] = frame.place.m[j][i] * square;
  }
  const TriangleBlock& block = *entry.block;
  block_bounds(block, turn, entry.center, lower, upper);
  const float margin = 1e-5f + slack_m_ + 2e-6f * block.radius * frame.place.scale;
  for (int k = 0; k < 3; ++k) {
    lower[k] -= margin;
    upper[k] += margin;
  }
}

double NearRegion::exit_t(const Ray& ray_W) const {
  if (holds_all_) return std::numeric_limits<double>::infinity();
  double t = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double d = ray_W.direction[axis];
    const double side = d > 0.0 ? half_size_m_ : -half_size_m_;
    if (d != 0.0) t = std::min(t, (center_W_[axis] + side - ray_W.origin[axis]) / d);
  }
  return t;
}

void NearRegion::add_draft(const EmbreeDevice& device, std::size_t budget_bytes) {
  tried_draft_ = true;
  if (scene_ == nullptr) return;
  std::vector<DraftBody> bodies(frames_.size());
  std::size_t triangles = 0;
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    bodies[k].placed = frames_[k].placed;
    triangles += frames_[k].placed->body->triangle_count();
  }
  if (triangles * kBytesPerDraftTriangle > budget_bytes) return;
  rest_.region = this;
  for (std::uint32_t k = 0; k < entries_.size(); ++k) {
    if (entries_[k].block != nullptr) continue;
    const Body& body = *bodies[entries_[k].frame].placed->body;
    const Piece& piece = body.pieces[entries_[k].piece];
    if (piece.kind == Piece::Kind::kPatch) {
      const HeightPatch& cells = body.patches[piece.index].cells;
      const auto more = static_cast<std::size_t>(2 * cells.rows * cells.columns);
      if ((triangles + more) * kBytesPerDraftTriangle <= budget_bytes) {
        triangles += more;
        bodies[entries_[k].frame].patches.push_back(piece.index);
        continue;
      }
    }
    rest_.entries.push_back(k);
  }
  if (triangles == 0) return;
  if (!rest_.entries.empty()) {
    rest_scene_ = std::make_unique<EmbreeScene>(
        device, rest_.entries.size(),
        [this](std::size_t k, float* lower, float* upper) {
          entry_bounds(rest_.entries[k], lower, upper);
        },
        &meet_rest_entry, &rest_, BuildQuality::kMedium);
  }
  draft_ = std::make_unique<DraftScene>(device, bodies, origin_W_);
}

bool NearRegion::find_passages(const RayQuery queries[kPacketRays],
                               const double t_high[kPacketRays],
                               Passage passages[kPacketRays]) const {
  bool any = false;
  for (int i = 0; i < kPacketRays; ++i) {
    if (t_high[i] < 0.0) continue;
    const Ray& ray_W = queries[i].ray_W();
    passages[i].ray = {ray_W.origin - origin_W_, ray_W.direction};
    passages[i].t_high = t_high[i];
    any = true;
    // From high above, floats are of the scenery's size from where the ray enters its layer.
    const double above = std::abs(passages[i].ray.origin.z()) - half_height_m_;
    if (above <= 0.0) continue;
    const double towards = -std::copysign(1.0, passages[i].ray.origin.z()) * ray_W.direction.z();
    passages[i].t_low = towards > 0.0 ? above / towards : std::numeric_limits<double>::infinity();
  }
  return any;
}

void NearRegion::meet(RayQuery queries[kPacketRays], const double t_high[kPacketRays]) const {
  Passage passages[kPacketRays];
  if (scene_ == nullptr || !find_passages(queries, t_high, passages)) return;
  traverse_packet(scene_->get(), queries, passages);
}

void NearRegion::meet_rest(RayQuery queries[kPacketRays], const double t_high[kPacketRays]) const {
  Passage passages[kPacketRays];
  if (rest_scene_ == nullptr || !find_passages(queries, t_high, passages)) return;
  traverse_packet(rest_scene_->get(), queries, passages);
}

void NearRegion::meet_rest_entry(const RTCIntersectFunctionNArguments* args) {
  const auto& rest = *static_cast<const Rest*>(args->geometryUserPtr);
  const Entry& entry = rest.region->entries_[rest.entries[args->primID]];
  const PlacedBody& placed = *rest.region->frames_[entry.frame].placed;
  for_each_ray(args, [&](RayQuery& query, RTCRayN*, unsigned, double) {
    query.enter(placed);
    query.meet_piece(placed.body->pieces[entry.piece]);
    return true;
  });
}

void NearRegion::meet_entry(const RTCIntersectFunctionNArguments* args) {
  const auto& region = *static_cast<const NearRegion*>(args->geometryUserPtr);
  const Entry& entry = region.entries_[args->primID];
  const Frame& frame = region.frames_[entry.frame];
  for_each_ray(args, [&](RayQuery& query, RTCRayN* rays, unsigned i, double) {
    if (entry.block == nullptr) {
      query.enter(*frame.placed);
      query.meet_piece(frame.placed->body->pieces[entry.piece]);
      return true;
    }
    const unsigned n = args->N;
    const RegionRay ray{
        {RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
        {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
        RTCRayN_tfar(rays, n, i)};
    const std::uint32_t marks =
        sort_out(*entry.block, frame.place, entry.center, ray, region.slack_m_);
    if (marks == 0) return false;
    query.enter(*frame.placed);
    query.meet_marked(*entry.block, marks);
    return true;
  });
}

std::size_t NearRegion::bytes() const {
  return entries_.capacity() * sizeof(Entry) + frames_.capacity() * sizeof(Frame) +
         (draft_ != nullptr ? draft_->bytes() : 0);
}

}  // namespace ardee
