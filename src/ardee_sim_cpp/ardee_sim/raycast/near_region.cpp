// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/near_region.h"

#include <algorithm>
#include <cmath>

namespace ardee {
namespace {

/// Of one entry with its share of Embree's tree (measured: README).
constexpr std::size_t kBytesPerEntry = 120;
/// Bodies wider than this are taken in piece by piece.
constexpr double kWide_m = 4.0;
constexpr double kEdge_m = 1e-2;
constexpr double kShrink = 0.8;
constexpr double kSmallest_m = 0.5;
constexpr double kFloatSlack = 1e-6;

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
  frame.scale = static_cast<float>(placed.scale);
  frame.placed = &placed;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) frame.m[i][j] = static_cast<float>(m(i, j));
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
    entries_.push_back({{static_cast<float>(center.x()), static_cast<float>(center.y()),
                         static_cast<float>(center.z())},
                        frame_index,
                        k});
    const Piece& piece = body.pieces[k];
    if (piece.kind == Piece::Kind::kBlock) triangles_ += body.blocks[piece.index].count;
  }
}

void NearRegion::entry_bounds(std::size_t index, float* lower, float* upper) const {
  const Entry& entry = entries_[index];
  const PlacedBody& placed = *frames_[entry.frame].placed;
  const Piece& piece = placed.body->pieces[entry.piece];
  if (piece.kind != Piece::Kind::kBlock) {
    Bounds box = placed.body->piece_bounds[entry.piece].transformed(
        placed.q.toRotationMatrix() * placed.scale, placed.p - origin_W_);
    round_outwards(box, extent_m_ + box.radius(), lower, upper);
    return;
  }
  // m is R_BW / scale: its transpose times the scale squared turns the block into the world.
  const Frame& frame = frames_[entry.frame];
  const float square = frame.scale * frame.scale;
  float turn[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) turn[i][j] = frame.m[j][i] * square;
  }
  const TriangleBlock& block = placed.body->blocks[piece.index];
  block_bounds(block, turn, entry.center, lower, upper);
  const float margin =
      1e-5f + 2.0f * slack_m_ + 2e-6f * static_cast<float>(block.radius) * frame.scale;
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

void NearRegion::meet(RayQuery& query, double t_high) const {
  if (scene_ == nullptr) return;
  const Ray ray{query.ray_W().origin - origin_W_, query.ray_W().direction};
  double t_low = 0.0;
  // Seen from high above, floats are of the scenery's size from where the ray enters its layer.
  if (std::abs(ray.origin.z()) > half_height_m_) {
    if (ray.origin.z() * ray.direction.z() >= 0.0) return;
    t_low = (std::abs(ray.origin.z()) - half_height_m_) / std::abs(ray.direction.z());
  }
  traverse(scene_->get(), query, ray, t_low, t_high);
}

void NearRegion::meet_block_entry(const Entry& entry, const RTCRayN* ray, RayQuery& query,
                                  double t_shift) const {
  const Frame& frame = frames_[entry.frame];
  const Body& body = *frame.placed->body;
  const TriangleBlock& block = body.blocks[body.pieces[entry.piece].index];
  const auto& r = *reinterpret_cast<const RTCRay*>(ray);
  const float cx = entry.center[0] - r.org_x;
  const float cy = entry.center[1] - r.org_y;
  const float cz = entry.center[2] - r.org_z;
  // From the point of the ray that is nearest to the centre.
  const float t_near = cx * r.dir_x + cy * r.dir_y + cz * r.dir_z;
  const float ox = t_near * r.dir_x - cx;
  const float oy = t_near * r.dir_y - cy;
  const float oz = t_near * r.dir_z - cz;
  const float radius = static_cast<float>(block.radius);
  const float t_radius = 2.0f * radius * frame.scale + 1e-3f;
  BlockRay local;
  for (int k = 0; k < 3; ++k) {
    const float* row = frame.m[k];
    local.origin[k] = row[0] * ox + row[1] * oy + row[2] * oz;
    local.direction[k] = row[0] * r.dir_x + row[1] * r.dir_y + row[2] * r.dir_z;
  }
  const float reach = static_cast<float>(query.reach() - t_shift);
  local.t_low = std::max(-t_near, -t_radius);
  local.t_high = std::min(reach - t_near, t_radius);
  local.slack_m = slack_m_ * 2.0f / frame.scale + 2e-6f * radius;
  std::int32_t marks[kBlockLanes];
  if (!sort_out(block, local, marks)) return;
  query.enter(*frame.placed);
  query.meet_marked(block, marks);
}

void NearRegion::meet_entry(const RTCIntersectFunctionNArguments* args) {
  if (args->valid[0] == 0) return;
  const auto* context = reinterpret_cast<const TraversalContext*>(args->context);
  const auto& region = *static_cast<const NearRegion*>(args->geometryUserPtr);
  const Entry& entry = region.entries_[args->primID];
  const PlacedBody& placed = *region.frames_[entry.frame].placed;
  const Piece& piece = placed.body->pieces[entry.piece];
  RayQuery& query = *context->query;
  const double reach = query.reach();
  RTCRayN* ray = RTCRayHitN_RayN(args->rayhit, args->N);
  if (piece.kind == Piece::Kind::kBlock) {
    region.meet_block_entry(entry, ray, query, context->t_shift);
  } else {
    query.enter(placed);
    query.meet_piece(piece);
  }
  if (query.reach() < reach) {
    RTCRayN_tfar(ray, args->N, 0) = float_above(query.reach() - context->t_shift);
  }
}

std::size_t NearRegion::bytes() const {
  return entries_.capacity() * sizeof(Entry) + frames_.capacity() * sizeof(Frame);
}

}  // namespace ardee
