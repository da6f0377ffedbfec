// SPDX-License-Identifier: MIT Conditions under which a model is left out of steps.
#include <algorithm>

#include "ardee_sim/physics/dynamic_model.h"

namespace ardee::physics {
namespace {

// A body that has stayed within these bounds for that long is at rest. Speeds alone do not suffice:
// a pendulum is slow at its turning points, and an intermittent contact gives a body the speed of
// one step's fall.
constexpr double kRestTime_s = 0.5;
constexpr double kRestShift_m = 5e-4;
constexpr double kRestTurn_rad = 1e-3;

bool is_near(const Pose& now, const Pose& before) {
  // The vector part of a small turn is half of it. Values that are not finite are not near.
  const double half_turn = (before.q.conjugate() * now.q).vec().norm();
  return (now.p - before.p).norm() <= kRestShift_m && half_turn <= 0.5 * kRestTurn_rad;
}

}  // namespace

void DynamicModel::watch_rest(double step_s) {
  if (still_poses_.size() == bodies_.size()) {
    still_s_ += step_s;
    bool is_still = true;
    for (std::size_t i = 0; i < bodies_.size() && is_still; ++i) {
      is_still = is_near(body_pose(body(i)), still_poses_[i]);
    }
    if (is_still) return;
  }
  still_s_ = 0.0;
  still_poses_.clear();
  for (const BodyHandle& each : bodies_) still_poses_.push_back(body_pose(each.get()));
}

bool DynamicModel::is_at_rest() const {
  if (!may_rest_ || still_s_ < kRestTime_s) return false;
  return std::none_of(joints_.begin(), joints_.end(),
                      [](const auto& joint) { return joint && joint->is_driven(); });
}

void DynamicModel::fall_asleep(std::uint64_t rest) {
  rest_ = rest;
  for (const BodyHandle& each : bodies_) {
    dBodySetLinearVel(each.get(), 0.0, 0.0, 0.0);
    dBodySetAngularVel(each.get(), 0.0, 0.0, 0.0);
  }
}

void DynamicModel::wake() {
  rest_ = 0;
  still_poses_.clear();
}

Eigen::AlignedBox3d DynamicModel::bounds() const {
  Eigen::AlignedBox3d all;
  for (const Shape& each : shapes_) all.extend(geom_bounds(each.shape.geom.get()));
  return all;
}

}  // namespace ardee::physics
