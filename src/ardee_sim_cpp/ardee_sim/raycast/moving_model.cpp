// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/moving_model.h"

#include <algorithm>
#include <cmath>

namespace ardee::raycast {
namespace {

/// Margin against rounding in the ball test.
constexpr double kBallMargin_m = 1e-6;
/// Factor on a ball's radius against rounding of floats.
constexpr double kRounding = 1.0 + 1e-4;

/// Returns whether a ray touches a box at t in [0, reach]. Zero components are infinite in
/// `inverse`: 0 * infinity gives NaN, which the order of the comparisons lets pass.
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

ShadowBall::ShadowBall(const Bounds& box_W)
    : center_W(box_W.center().cast<float>()),
      radius_m(static_cast<float>(box_W.radius() * kRounding + kBallMargin_m)) {}

bool ShadowBall::may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                           float about_m) const {
  const float reach_m = radius_m + about_m;
  const Eigen::Vector3f to_center = center_W - at_W;
  const float along_m = std::max(0.0f, to_center.dot(to_lamp_W));
  return (to_center - along_m * to_lamp_W).squaredNorm() <= reach_m * reach_m;
}

void MovingModel::intersect(RayQuery* queries, int count) const {
  if (boxes_W.empty()) return;
  thread_local std::vector<double> entries;
  thread_local std::vector<double> exits;
  thread_local std::vector<std::uint32_t> near;
  near.clear();
  RayBundle(queries, count).find(box_table_W, entries, exits, near);
  if (near.empty()) return;
  for (int i = 0; i < count; ++i) {
    RayQuery& query = queries[i];
    const Ray& ray = query.ray_W();
    const Eigen::Vector3d inverse = ray.direction.cwiseInverse();
    for (const std::uint32_t k : near) {
      if (query.passes(entity, links[k])) continue;
      if (touches(boxes_W[k], ray.origin, inverse, query.reach())) {
        query.intersect_traceable(placed[k], 0.0);
      }
    }
  }
}

void ModelList::remove(const MovingModel& model) {
  models_.erase(std::remove(models_.begin(), models_.end(), &model), models_.end());
}

bool ModelList::may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                          float about_m) const {
  return std::any_of(models_.begin(), models_.end(), [&](const MovingModel* model) {
    return !model->boxes_W.empty() && model->ball.may_shade(at_W, to_lamp_W, about_m);
  });
}

bool ModelList::touches_any(const Ray& ray_W, double reach_m) const {
  const Eigen::Vector3d inverse = ray_W.direction.cwiseInverse();
  return std::any_of(models_.begin(), models_.end(), [&](const MovingModel* model) {
    return !model->boxes_W.empty() && touches(model->box_W, ray_W.origin, inverse, reach_m);
  });
}

bool ModelList::may_touch_some(const Eigen::Vector3d& eye_W, const PrimaryRayPacket& rays) const {
  if (models_.empty()) return false;
  float spread2 = 0.0f;  // greatest squared distance between directions
  for (int i = 1; i < PrimaryRayPacket::kRays; ++i) {
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
  return std::any_of(models_.begin(), models_.end(), [&](const MovingModel* model) {
    if (model->boxes_W.empty()) return false;
    const Eigen::Vector3d to_box = model->box_W.center() - eye_W;
    const double radius_m = model->box_W.radius();
    const double along_m = std::max(0.0, to_box.dot(way_W));
    const double apart_m = (to_box - along_m * way_W).norm();
    if (apart_m > radius_m + spread * (along_m + radius_m)) return false;
    // A camera's own robot is always near.
    near.clear();
    bundle.find(model->box_table_W, entries, exits, near);
    return !near.empty();
  });
}

void ModelList::intersect(RayQuery queries[kPacketRays], int count) const {
  for (const MovingModel* model : models_) model->intersect(queries, count);
}

}  // namespace ardee::raycast
