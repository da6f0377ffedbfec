// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/models_beside.h"

#include <algorithm>

namespace ardee::raycast {
namespace {

/// Least number of models at rest beside the triangle scene, and of calls of prepare() since its
/// making, that justify another local scene.
constexpr std::size_t kManyAtRest = 16;
constexpr std::uint64_t kShortest = 100;
/// Number of models beside the triangle scene above which they are not tested one by one.
constexpr std::size_t kManyBeside = 64;

}  // namespace

void ModelsBeside::find(const LocalScene& local, const MovingModels& moving) {
  *this = ModelsBeside(since_);
  std::size_t at_rest = 0;
  std::size_t in_tree = 0;
  for (const auto& [entity, model] : moving.models()) {
    if (model.placed.empty() || model.boxes_W.empty()) continue;
    if (model.in_tree) {
      are_beyond_ = are_beyond_ || !local.holds(model.box_W);
      if (!local.touches(model.box_W) || MovingModels::was_still(model, since_)) continue;
    }
    models_.add(model);
    in_tree += model.in_tree ? 1 : 0;
    if (moving.is_at_rest(model)) ++at_rest;
  }
  for (const StillInstance& body : local.still()) {
    if (*body.moved_at > since_) gone_.emplace_back(body.placed.bounds_W());
  }
  ask_tree_ = in_tree > kManyBeside;
  outdate_ = at_rest >= kManyAtRest && moving.time() >= since_ + kShortest;
}

bool ModelsBeside::may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                             float about_m) const {
  return models_.may_shade(at_W, to_lamp_W, about_m) ||
         std::any_of(gone_.begin(), gone_.end(), [&](const ShadowBall& ball) {
           return ball.may_shade(at_W, to_lamp_W, about_m);
         });
}

}  // namespace ardee::raycast
