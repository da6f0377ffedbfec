// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/moving_models.h"

#include <algorithm>

#include "ardee_sim/raycast/traceable_compiler.h"

namespace ardee::raycast {
namespace {

/// Margin against rounding in the box test.
constexpr double kBoxMargin_m = 1e-6;
/// Distance that the box about a link may move before its model counts as moved.
constexpr double kRoom_m = 0.02;
/// Number of calls of prepare() without motion after which a model counts as at rest.
constexpr std::uint64_t kLong = 10;
/// Least number of models that justify a new tree.
constexpr std::ptrdiff_t kMany = 16;

bool holds(const Bounds& room, const Bounds& box) {
  return (room.lower.array() <= box.lower.array()).all() &&
         (box.upper.array() <= room.upper.array()).all();
}

bool is_at(const TraceableInstance& placed, const Pose& pose) {
  return placed.p == pose.p && placed.q.coeffs() == pose.q.normalized().coeffs();
}

void make_room(MovingModel& model) {
  model.rooms_W.clear();
  for (const Bounds& box : model.boxes_W) model.rooms_W.push_back(box.grown(kRoom_m));
}

}  // namespace

void MovingModels::add(std::uint32_t entity, std::shared_ptr<const Model> model,
                       std::uint32_t label) {
  if (model == nullptr) throw Error("a moving model needs a description");
  if (models_.count(entity) != 0) {
    throw Error("model '" + model->name + "': entity " + std::to_string(entity) + " is in use");
  }
  MovingModel made;
  made.entity = entity;
  made.bodies = compile_links(model, kind_, log_);
  for (std::uint32_t link = 0; link < model->links.size(); ++link) {
    const Traceable& body = *(*made.bodies)[link];
    if (body.primitives.empty() && body.grounds.empty()) continue;
    TraceableInstance placed;
    placed.body = &body;
    placed.entity = entity;
    placed.label = label;
    made.placed.push_back(placed);
    made.links.push_back(link);
  }
  made.model = std::move(model);
  const MovingModel& added = models_.emplace(entity, std::move(made)).first->second;
  if (!added.placed.empty()) loose_.add(added);
}

void MovingModels::remove(std::uint32_t entity) {
  const auto found = models_.find(entity);
  if (found == models_.end()) {
    throw Error("there is no moving model " + std::to_string(entity) + " to remove");
  }
  // The tree may hold its links, even if it has moved since.
  tree_.clear();
  for (auto& [other, model] : models_) {
    if (model.in_tree) loosen(model);
  }
  *found->second.moved_at = MovingModel::kNever;
  loose_.remove(found->second);
  models_.erase(found);
}

void MovingModels::loosen(MovingModel& model) {
  model.in_tree = false;
  loose_.add(model);
}

void MovingModels::prepare() {
  ++time_;
  const auto stays = [this](const MovingModel& model) {
    return !model.boxes_W.empty() && (model.left_at == 0 || time_ - model.left_at >= kLong);
  };
  const auto& loose = loose_.models();
  if (std::count_if(loose.begin(), loose.end(), [&](const auto* each) { return stays(*each); }) <
      kMany) {
    return;
  }
  std::vector<const TraceableInstance*> places;
  loose_.clear();
  for (auto& [entity, model] : models_) {
    if (model.placed.empty()) continue;
    model.in_tree = stays(model);
    if (!model.in_tree) {
      loose_.add(model);
      continue;
    }
    model.stays_since = std::min(model.stays_since, time_);
    make_room(model);
    for (const TraceableInstance& placed : model.placed) {
      if (!placed.body->primitives.empty()) places.push_back(&placed);
    }
  }
  tree_.build(std::move(places), BuildQuality::kLow, kRoom_m);
}

void MovingModels::set_link_poses(std::uint32_t entity, const std::vector<Pose>& X_WL) {
  const auto found = models_.find(entity);
  if (found == models_.end()) {
    throw Error("there is no moving model " + std::to_string(entity) + " to place");
  }
  MovingModel& model = found->second;
  const std::vector<Link>& links = model.model->links;
  if (X_WL.size() != links.size()) {
    throw Error("model '" + model.model->name + "': " + std::to_string(X_WL.size()) +
                " link poses for " + std::to_string(links.size()) + " links");
  }
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!X_WL[k].is_finite()) {
      throw Error("model '" + model.model->name + "': the pose of link '" + links[k].name +
                  "' is not finite");
    }
  }
  if (model.placed.empty()) return;
  model.boxes_W.resize(model.placed.size());
  model.box_table_W.clear();
  model.box_W = Bounds{};
  bool moved = false;
  for (std::size_t k = 0; k < model.placed.size(); ++k) {
    const Pose& pose = X_WL[model.links[k]];
    TraceableInstance& placed = model.placed[k];
    moved = moved || !is_at(placed, pose);
    placed.p = pose.p;
    placed.q = pose.q.normalized();
    model.boxes_W[k] = placed.bounds_W().grown(kBoxMargin_m);
    model.box_table_W.add(model.boxes_W[k]);
    model.box_W.add(model.boxes_W[k]);
  }
  model.ball = ShadowBall(model.box_W);
  if (model.rooms_W.empty()) {
    make_room(model);
    return;
  }
  if (moved) *model.moved_at = time_ + 1;
  if (!std::equal(model.rooms_W.begin(), model.rooms_W.end(), model.boxes_W.begin(),
                  model.boxes_W.end(), holds)) {
    if (model.in_tree) loosen(model);
    make_room(model);
    model.left_at = time_;
    model.stays_since = MovingModel::kNever;
  }
}

bool MovingModels::is_at_rest(const MovingModel& model) const {
  return model.in_tree && time_ >= *model.moved_at + kLong;
}

StillInstances MovingModels::still_instances() const {
  StillInstances still;
  still.time = time_;
  for (const auto& [entity, model] : models_) {
    if (!model.in_tree) continue;
    for (const TraceableInstance& placed : model.placed) {
      if (!placed.body->primitives.empty()) {
        still.bodies.push_back({placed, model.bodies, model.moved_at});
      }
    }
  }
  return still;
}

void MovingModels::intersect(RayQuery queries[kPacketRays], int count) const {
  loose_.intersect(queries, count);
  if (tree_.empty()) return;
  double t_low[kPacketRays];
  for (int i = 0; i < kPacketRays; ++i) {
    t_low[i] = i < count ? 0.0 : std::numeric_limits<double>::infinity();
  }
  tree_.intersect(queries, t_low);
}

void MovingModels::intersect(RayQuery& query, std::uint32_t entity) const {
  const auto found = models_.find(entity);
  if (found != models_.end()) found->second.intersect(&query, 1);
}

}  // namespace ardee::raycast
