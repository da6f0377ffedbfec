// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/local_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardee::raycast {
namespace {

/// Width above which a body is added primitive by primitive.
constexpr double kWide_m = 4.0;
constexpr double kEdge_m = 1e-2;
constexpr double kSmallest_m = 0.5;
constexpr double kFloatSlack = 2e-6;

bool is_wide(const TraceableInstance& placed) {
  return placed.body->bounds.radius() * placed.scale > kWide_m;
}

Bounds primitive_bounds_W(const TraceableInstance& placed, std::size_t primitive) {
  return placed.body->primitive_bounds[primitive].transformed(
      placed.q.toRotationMatrix() * placed.scale, placed.p);
}

/// Returns half the side of the smallest square about `center` that touches the box [m].
double reach_m(const Eigen::Vector2d& center, const Bounds& box) {
  return (box.lower.head<2>() - center).cwiseMax(center - box.upper.head<2>()).maxCoeff();
}

std::size_t triangles_of(const Traceable& body, const Primitive& primitive) {
  if (primitive.kind != Primitive::Kind::kPatch) return 0;
  const HeightPatch& cells = body.patches[primitive.index].cells;
  return static_cast<std::size_t>(2 * cells.rows * cells.columns);
}

}  // namespace

LocalScene::LocalScene(std::shared_ptr<const FixedScenery> scenery, const StillInstances& still,
                       const LocalSceneRequest& request)
    : scenery_(std::move(scenery)),
      center_W_(request.center_W),
      half_size_m_(request.half_size_m),
      for_pictures_(request.budget.triangle_bytes > 0),
      time_(still.time) {
  const PlaceTree& tree = scenery_->places();
  choose_size(still, request.budget);
  if (for_pictures_) take_still(still);
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(half_size_m_ + kEdge_m);
  Bounds all = tree.bounds_W();
  for (const StillInstance& body : still_) all.add(body.placed.bounds_W());
  origin_W_ << center_W_, all.empty() ? 0.0 : all.center().z();
  std::size_t places = 0;
  tree.find(center_W_ - half, center_W_ + half, [&](std::size_t index) {
    const TraceableInstance& placed = *tree.places()[index];
    ++places;
    add(placed);
  });
  const bool inside = !all.empty() && (all.lower.head<2>() - center_W_ + half).minCoeff() >= 0.0 &&
                      (center_W_ + half - all.upper.head<2>()).minCoeff() >= 0.0;
  holds_all_ = places == tree.places().size() && inside;
  half_height_m_ = 0.5 * (all.upper - all.lower).z() + kEdge_m;
  extent_m_ = 2.0 * (half_size_m_ + half_height_m_);
  slack_m_ = static_cast<float>(kFloatSlack * extent_m_);
  if (!entries_.empty()) {
    scene_ = std::make_unique<EmbreeScene>(
        entries_.size(),
        [this](std::size_t index, float* lower, float* upper) {
          entry_bounds(index, lower, upper);
        },
        &intersect_entry, this, BuildQuality::kMedium);
  }
  for (const StillInstance& body : still_) add(body.placed, body.moved_at.get());
  if (for_pictures_) add_triangle_scene(request.budget.triangle_bytes);
}

void LocalScene::take_still(const StillInstances& still) {
  for (const StillInstance& body : still.bodies) {
    if (touches(body.placed.bounds_W())) still_.push_back(body);
  }
}

bool LocalScene::touches(const Bounds& box_W) const {
  return reach_m(center_W_, box_W) <= half_size_m_ + kEdge_m;
}

bool LocalScene::holds(const Bounds& box_W) const {
  return (box_W.lower.head<2>() - center_W_).minCoeff() >= -half_size_m_ &&
         (box_W.upper.head<2>() - center_W_).maxCoeff() <= half_size_m_;
}

/// Chooses the largest square that fits into the budget.
void LocalScene::choose_size(const StillInstances& still, const LocalSceneBudget& budget) {
  struct Part {
    double reach_m;
    std::size_t entries;
    std::size_t triangles;
  };
  std::vector<Part> parts;
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(half_size_m_ + kEdge_m);
  const PlaceTree& tree = scenery_->places();
  tree.find(center_W_ - half, center_W_ + half, [&](std::size_t index) {
    const TraceableInstance& placed = *tree.places()[index];
    const Traceable& body = *placed.body;
    if (!is_wide(placed)) {
      std::size_t triangles = body.triangle_count();
      for (const Primitive& primitive : body.primitives) triangles += triangles_of(body, primitive);
      parts.push_back({reach_m(center_W_, placed.bounds_W()), body.primitives.size(), triangles});
      return;
    }
    // A triangle scene contains all triangles of a mesh, whatever the size.
    parts.push_back({-std::numeric_limits<double>::infinity(), 0, body.triangle_count()});
    for (std::size_t k = 0; k < body.primitives.size(); ++k) {
      const double reach = reach_m(center_W_, primitive_bounds_W(placed, k));
      if (reach > half_size_m_) continue;
      parts.push_back({reach, 1, triangles_of(body, body.primitives[k])});
    }
  });
  for (const StillInstance& body : still.bodies) {
    if (!for_pictures_ || !touches(body.placed.bounds_W())) continue;
    parts.push_back({reach_m(center_W_, body.placed.bounds_W()),
                     body.placed.body->primitives.size(), body.placed.body->triangle_count()});
  }
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.reach_m < b.reach_m; });
  const auto largest_m = [&](std::size_t most_entries, std::size_t most_triangles) {
    std::size_t entries = 0;
    std::size_t triangles = 0;
    for (const Part& part : parts) {
      entries += part.entries;
      triangles += part.triangles;
      if (entries > most_entries || triangles > most_triangles) {
        return part.reach_m - 2.0 * kEdge_m;
      }
    }
    return half_size_m_;
  };
  constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();
  const std::size_t most_entries = budget.entries / kBytesPerEntry;
  double largest = kSmallest_m;
  if (for_pictures_) largest = largest_m(most_entries, budget.triangle_bytes / kBytesPerTriangle);
  // A triangle scene that does not fit even into the smallest square is left out.
  if (largest <= kSmallest_m) largest = largest_m(most_entries, kNoLimit);
  half_size_m_ = std::min(half_size_m_, std::max(largest, kSmallest_m));
}

void LocalScene::add(const TraceableInstance& placed, const std::uint64_t* moved_at) {
  const Traceable& body = *placed.body;
  const Eigen::Matrix3d R_WB = placed.q.toRotationMatrix();
  const Eigen::Matrix3d m = R_WB.transpose() / placed.scale;
  Frame frame;
  frame.place.scale = static_cast<float>(placed.scale);
  frame.placed = &placed;
  frame.moved_at = moved_at;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) frame.place.m[i][j] = static_cast<float>(m(i, j));
  }
  const auto frame_index = static_cast<std::uint32_t>(frames_.size());
  frames_.push_back(frame);
  const bool wide = is_wide(placed);
  for (std::uint32_t k = 0; k < body.primitives.size(); ++k) {
    const Bounds& box_B = body.primitive_bounds[k];
    if (wide && reach_m(center_W_, primitive_bounds_W(placed, k)) > half_size_m_ + kEdge_m)
      continue;
    const Eigen::Vector3d center = placed.p + R_WB * (placed.scale * box_B.center()) - origin_W_;
    Entry entry{};
    for (int i = 0; i < 3; ++i) entry.center[i] = static_cast<float>(center[i]);
    entry.frame = frame_index;
    entry.primitive = k;
    if (body.primitives[k].kind == Primitive::Kind::kBlock) {
      entry.block = &body.blocks[body.primitives[k].index];
      triangles_ += entry.block->count;
    }
    entries_.push_back(entry);
  }
}

void LocalScene::entry_bounds(std::size_t index, float* lower, float* upper) const {
  const Entry& entry = entries_[index];
  const TraceableInstance& placed = *frames_[entry.frame].placed;
  if (entry.block == nullptr) {
    Bounds box = placed.body->primitive_bounds[entry.primitive].transformed(
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

double LocalScene::exit_t(const Ray& ray_W) const {
  return holds_all_ ? std::numeric_limits<double>::infinity() : border_t(ray_W);
}

double LocalScene::border_t(const Ray& ray_W) const {
  double t = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    const double d = ray_W.direction[axis];
    const double side = d > 0.0 ? half_size_m_ : -half_size_m_;
    if (d != 0.0) t = std::min(t, (center_W_[axis] + side - ray_W.origin[axis]) / d);
  }
  return t;
}

void LocalScene::add_triangle_scene(std::size_t budget_bytes) {
  std::vector<TriangleSource> bodies(frames_.size());
  std::size_t triangles = 0;
  for (std::size_t k = 0; k < frames_.size(); ++k) {
    bodies[k].placed = frames_[k].placed;
    bodies[k].moved_at = frames_[k].moved_at;
    triangles += frames_[k].placed->body->triangle_count();
  }
  if (triangles * kBytesPerTriangle > budget_bytes) return;
  rest_.local = this;
  for (std::uint32_t k = 0; k < entries_.size(); ++k) {
    if (entries_[k].block != nullptr) continue;
    const Traceable& body = *bodies[entries_[k].frame].placed->body;
    const Primitive& primitive = body.primitives[entries_[k].primitive];
    if (primitive.kind == Primitive::Kind::kPatch &&
        frames_[entries_[k].frame].moved_at == nullptr) {
      const std::size_t more = triangles_of(body, primitive);
      if ((triangles + more) * kBytesPerTriangle <= budget_bytes) {
        triangles += more;
        bodies[entries_[k].frame].patches.push_back(primitive.index);
        continue;
      }
    }
    rest_.entries.push_back(k);
  }
  if (triangles == 0) return;
  if (!rest_.entries.empty()) {
    rest_scene_ = std::make_unique<EmbreeScene>(
        rest_.entries.size(),
        [this](std::size_t k, float* lower, float* upper) {
          entry_bounds(rest_.entries[k], lower, upper);
        },
        &intersect_rest_entry, &rest_, BuildQuality::kMedium);
  }
  triangle_scene_ = std::make_unique<TriangleScene>(bodies, origin_W_, time_);
}

bool LocalScene::find_segments(const RayQuery queries[kPacketRays],
                               const double t_high[kPacketRays],
                               RaySegment passages[kPacketRays]) const {
  bool any = false;
  for (int i = 0; i < kPacketRays; ++i) {
    if (t_high[i] < 0.0) continue;
    const Ray& ray_W = queries[i].ray_W();
    passages[i].ray = {ray_W.origin - origin_W_, ray_W.direction};
    passages[i].t_high = t_high[i];
    any = true;
    // From high above, the ray starts where it enters the scenery's layer, so that floats are of
    // the scenery's size.
    const double above = std::abs(passages[i].ray.origin.z()) - half_height_m_;
    if (above <= 0.0) continue;
    const double towards = -std::copysign(1.0, passages[i].ray.origin.z()) * ray_W.direction.z();
    passages[i].t_low = towards > 0.0 ? above / towards : std::numeric_limits<double>::infinity();
  }
  return any;
}

void LocalScene::intersect(RayQuery queries[kPacketRays], const double t_high[kPacketRays]) const {
  RaySegment passages[kPacketRays];
  if (scene_ == nullptr || !find_segments(queries, t_high, passages)) return;
  traverse_packet(scene_->get(), queries, passages);
}

void LocalScene::intersect_rest(RayQuery queries[kPacketRays],
                                const double t_high[kPacketRays]) const {
  RaySegment passages[kPacketRays];
  if (rest_scene_ == nullptr || !find_segments(queries, t_high, passages)) return;
  traverse_packet(rest_scene_->get(), queries, passages);
}

void LocalScene::intersect_rest_entry(const RTCIntersectFunctionNArguments* args) {
  const auto& rest = *static_cast<const Rest*>(args->geometryUserPtr);
  const Entry& entry = rest.local->entries_[rest.entries[args->primID]];
  const Frame& frame = rest.local->frames_[entry.frame];
  if (frame.moved_at != nullptr && *frame.moved_at > rest.local->time_) return;
  const TraceableInstance& placed = *frame.placed;
  for_each_ray(args, [&](RayQuery& query, RTCRayN*, unsigned, double) {
    query.enter(placed);
    query.intersect_primitive(placed.body->primitives[entry.primitive]);
    return true;
  });
}

void LocalScene::intersect_entry(const RTCIntersectFunctionNArguments* args) {
  const auto& local = *static_cast<const LocalScene*>(args->geometryUserPtr);
  const Entry& entry = local.entries_[args->primID];
  const Frame& frame = local.frames_[entry.frame];
  for_each_ray(args, [&](RayQuery& query, RTCRayN* rays, unsigned i, double) {
    if (entry.block == nullptr) {
      query.enter(*frame.placed);
      query.intersect_primitive(frame.placed->body->primitives[entry.primitive]);
      return true;
    }
    const unsigned n = args->N;
    const LocalRay ray{
        {RTCRayN_org_x(rays, n, i), RTCRayN_org_y(rays, n, i), RTCRayN_org_z(rays, n, i)},
        {RTCRayN_dir_x(rays, n, i), RTCRayN_dir_y(rays, n, i), RTCRayN_dir_z(rays, n, i)},
        RTCRayN_tfar(rays, n, i)};
    const std::uint32_t marks =
        cull_conservatively(*entry.block, frame.place, entry.center, ray, local.slack_m_);
    if (marks == 0) return false;
    query.enter(*frame.placed);
    query.intersect_marked(*entry.block, marks);
    return true;
  });
}

std::size_t LocalScene::bytes() const {
  return entries_.capacity() * sizeof(Entry) + frames_.capacity() * sizeof(Frame) +
         (triangle_scene_ != nullptr ? triangle_scene_->bytes() : 0);
}

}  // namespace ardee::raycast
