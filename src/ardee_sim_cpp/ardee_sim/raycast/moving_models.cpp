// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/moving_models.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/raycast/body_compiler.h"

namespace ardee {
namespace {

/// Against rounding in the box test only.
constexpr double kBoxMargin_m = 1e-6;

/// Of a ball's radius, for floats.
constexpr double kRounding = 1.0 + 1e-4;

/// How far the box about a link may move before its model counts as moved.
constexpr double kRoom_m = 0.02;
/// What has not moved for so many calls of prepare(), or never, stays where it is.
constexpr std::uint64_t kLong = 10;
/// Fewer models than these are not worth a new tree.
constexpr std::ptrdiff_t kMany = 16;

bool holds(const Bounds& room, const Bounds& box) {
  return (room.lower.array() <= box.lower.array()).all() &&
         (box.upper.array() <= room.upper.array()).all();
}

/// Whether a ray touches a box at t in [0, reach]. Zero components are infinite in `inverse`: 0 *
/// infinity gives NaN, which the order of the comparisons lets pass.
bool touches(const Bounds& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& inverse,
             double reach) {
  double t_in = 0.0;
  double t_out = reach;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.lower[k] - origin[k]) * inverse[k];
    const double b = (box.upper[k] - origin[k]) * inverse[k];
    const double low = a < b ? a : b;
    const double high = a < b ? b : a;
    if (low > t_in) t_in = low;
    if (high < t_out) t_out = high;
  }
  return t_in <= t_out;
}

}  // namespace

/// Those of models that are the same description are the same.
std::shared_ptr<const MovingModels::Bodies> MovingModels::bodies_of(
    const std::shared_ptr<const Model>& model) {
  std::weak_ptr<const Bodies>& known = compiled_[model.get()];
  if (auto bodies = known.lock()) return bodies;
  auto made = std::make_shared<Bodies>();
  for (std::uint32_t link = 0; link < model->links.size(); ++link) {
    made->push_back(compile_link(device_, masks_, *model, link, kind_));
  }
  known = made;
  return made;
}

void MovingModels::add(std::uint32_t entity, std::shared_ptr<const Model> model) {
  if (model == nullptr) throw Error("a moving model needs a description");
  if (entries_.count(entity) != 0) {
    throw Error("model '" + model->name + "': entity " + std::to_string(entity) + " is in use");
  }
  Entry entry;
  entry.entity = entity;
  entry.bodies = bodies_of(model);
  for (std::uint32_t link = 0; link < model->links.size(); ++link) {
    const Body& body = *(*entry.bodies)[link];
    if (body.pieces.empty() && body.grounds.empty()) continue;
    PlacedBody placed;
    placed.body = &body;
    placed.entity = entity;
    entry.placed.push_back(placed);
    entry.links.push_back(link);
  }
  entry.model = std::move(model);
  Entry& added = entries_.emplace(entity, std::move(entry)).first->second;
  if (!added.placed.empty()) loose_.push_back(&added);
}

void MovingModels::remove(std::uint32_t entity) {
  const auto found = entries_.find(entity);
  if (found == entries_.end()) {
    throw Error("there is no moving model " + std::to_string(entity) + " to remove");
  }
  // The tree may hold its links, even if it has moved since.
  tree_.clear();
  for (auto& [other, entry] : entries_) loosen(entry);
  loose_.erase(std::remove(loose_.begin(), loose_.end(), &found->second), loose_.end());
  entries_.erase(found);
  for (auto known = compiled_.begin(); known != compiled_.end();) {
    known = known->second.expired() ? compiled_.erase(known) : std::next(known);
  }
}

void MovingModels::loosen(Entry& entry) {
  if (!entry.in_tree) return;
  entry.in_tree = false;
  loose_.push_back(&entry);
}

void MovingModels::make_room(Entry& entry) {
  entry.rooms_W.clear();
  for (const Bounds& box : entry.boxes_W) entry.rooms_W.push_back(box.grown(kRoom_m));
}

void MovingModels::prepare() {
  ++time_;
  const auto stays = [this](const Entry* entry) {
    return !entry->boxes_W.empty() && (entry->left_at == 0 || time_ - entry->left_at >= kLong);
  };
  if (std::count_if(loose_.begin(), loose_.end(), stays) < kMany) return;
  std::vector<const PlacedBody*> places;
  loose_.clear();
  for (auto& [entity, entry] : entries_) {
    if (entry.placed.empty()) continue;
    entry.in_tree = stays(&entry);
    if (!entry.in_tree) {
      loose_.push_back(&entry);
      continue;
    }
    make_room(entry);
    for (const PlacedBody& placed : entry.placed) {
      if (!placed.body->pieces.empty()) places.push_back(&placed);
    }
  }
  tree_.build(device_, std::move(places), BuildQuality::kLow, kRoom_m);
  tree_box_W_.clear();
  tree_box_W_.add(tree_.bounds_W());
}

void MovingModels::set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL) {
  const auto found = entries_.find(entity);
  if (found == entries_.end()) {
    throw Error("there is no moving model " + std::to_string(entity) + " to place");
  }
  Entry& entry = found->second;
  const std::vector<Link>& links = entry.model->links;
  if (X_WL.size() != links.size()) {
    throw Error("model '" + entry.model->name + "': " + std::to_string(X_WL.size()) +
                " link poses for " + std::to_string(links.size()) + " links");
  }
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!X_WL[k].is_finite()) {
      throw Error("model '" + entry.model->name + "': the pose of link '" + links[k].name +
                  "' is not finite");
    }
  }
  entry.boxes_W.resize(entry.placed.size());
  entry.box_table_W.clear();
  entry.box_W = Bounds{};
  for (std::size_t k = 0; k < entry.placed.size(); ++k) {
    const Pose& pose = X_WL[entry.links[k]];
    entry.placed[k].p = pose.p;
    entry.placed[k].q = pose.q.normalized();
    entry.boxes_W[k] = entry.placed[k].bounds_W().grown(kBoxMargin_m);
    entry.box_table_W.add(entry.boxes_W[k]);
    entry.box_W.add(entry.boxes_W[k]);
  }
  if (entry.rooms_W.empty()) {
    make_room(entry);
  } else if (!std::equal(entry.rooms_W.begin(), entry.rooms_W.end(), entry.boxes_W.begin(),
                         entry.boxes_W.end(), holds)) {
    loosen(entry);
    make_room(entry);
    entry.left_at = time_;
  }
  if (entry.placed.empty()) return;
  entry.center_W = entry.box_W.center().cast<float>();
  entry.radius_m = static_cast<float>(entry.box_W.radius() * kRounding + kBoxMargin_m);
}

bool MovingModels::may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                             float about_m) const {
  for (const auto& [entity, entry] : entries_) {
    if (entry.boxes_W.empty()) continue;
    const float radius_m = entry.radius_m + about_m;
    const Eigen::Vector3f to_center = entry.center_W - at_W;
    const float along_m = std::max(0.0f, to_center.dot(to_lamp_W));
    if ((to_center - along_m * to_lamp_W).squaredNorm() <= radius_m * radius_m) return true;
  }
  return false;
}

bool MovingModels::touches_any(const Ray& ray_W, double reach_m) const {
  if (entries_.empty()) return false;
  const Eigen::Vector3d inverse = ray_W.direction.cwiseInverse();
  const auto touches_box = [&](const Bounds& box_W) {
    return touches(box_W, ray_W.origin, inverse, reach_m);
  };
  if (!tree_.empty() && touches_box(tree_.bounds_W())) return true;
  return std::any_of(loose_.begin(), loose_.end(), [&](const Entry* entry) {
    return !entry->boxes_W.empty() && touches_box(entry->box_W);
  });
}

bool MovingModels::may_touch_some(const Eigen::Vector3d& eye_W, const GlanceBlock& rays) const {
  if (entries_.empty()) return false;
  float spread2 = 0.0f;  // of distances between directions, at most
  for (int i = 1; i < GlanceBlock::kRays; ++i) {
    const float x = rays.x_W[i] - rays.x_W[0];
    const float y = rays.y_W[i] - rays.y_W[0];
    const float z = rays.z_W[i] - rays.z_W[0];
    spread2 = std::max(spread2, x * x + y * y + z * z);
  }
  const auto spread = static_cast<double>(std::sqrt(spread2));
  const Eigen::Vector3d way_W = rays.direction_W(0).cast<double>();
  const RayBundle bundle(eye_W, rays);
  thread_local std::vector<double> entries;
  thread_local std::vector<double> exits;
  thread_local std::vector<std::uint32_t> near;
  const auto may_touch = [&](const Bounds& box_W, const BoxTable& boxes_W) {
    const Eigen::Vector3d to_box = box_W.center() - eye_W;
    const double radius_m = box_W.radius();
    const double along_m = std::max(0.0, to_box.dot(way_W));
    const double apart_m = (to_box - along_m * way_W).norm();
    if (apart_m > radius_m + spread * (along_m + radius_m)) return false;
    // A camera's own robot is always about it.
    near.clear();
    bundle.find(boxes_W, entries, exits, near);
    return !near.empty();
  };
  if (!tree_.empty() && may_touch(tree_.bounds_W(), tree_box_W_)) return true;
  return std::any_of(loose_.begin(), loose_.end(), [&](const Entry* entry) {
    return !entry->boxes_W.empty() && may_touch(entry->box_W, entry->box_table_W);
  });
}

void MovingModels::meet(RayQuery queries[kPacketRays], int count) const {
  for (const Entry* entry : loose_) meet(queries, count, *entry);
  if (tree_.empty()) return;
  double t_low[kPacketRays];
  for (int i = 0; i < kPacketRays; ++i) {
    t_low[i] = i < count ? 0.0 : std::numeric_limits<double>::infinity();
  }
  tree_.meet(queries, t_low);
}

void MovingModels::meet(RayQuery& query, std::uint32_t entity) const {
  const auto found = entries_.find(entity);
  if (found != entries_.end()) meet(&query, 1, found->second);
}

void MovingModels::meet(RayQuery* queries, int count, const Entry& entry) {
  if (entry.boxes_W.empty()) return;
  thread_local std::vector<double> entries;
  thread_local std::vector<double> exits;
  thread_local std::vector<std::uint32_t> near;
  near.clear();
  RayBundle(queries, count).find(entry.box_table_W, entries, exits, near);
  if (near.empty()) return;
  for (int i = 0; i < count; ++i) {
    RayQuery& query = queries[i];
    const Ray& ray = query.ray_W();
    const Eigen::Vector3d inverse = ray.direction.cwiseInverse();
    for (const std::uint32_t k : near) {
      if (query.passes(entry.entity, entry.links[k])) continue;
      if (touches(entry.boxes_W[k], ray.origin, inverse, query.reach())) {
        query.meet_body(entry.placed[k], 0.0);
      }
    }
  }
}

}  // namespace ardee
