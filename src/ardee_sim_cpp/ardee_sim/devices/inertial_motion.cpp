// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/inertial_motion.h"

#include <cmath>

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

/// Axis times angle in rad of the shorter turn.
Vector3d rotation_vector(Eigen::Quaterniond q) {
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  constexpr double kTiny = 1e-9;
  if (sine < kTiny) return 2.0 * q.vec();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

}  // namespace

void InertialMotion::on_set_state() {
  const Twist twist_W = robot_.link_twist(link_);
  velocity_W_ = twist_W.linear + twist_W.angular.cross(robot_.link_pose(link_).q * X_LS_.p);
}

void InertialMotion::reset(TimeNs now_ns) {
  on_set_state();
  sum_ = Mean{};
  summed_s_ = 0.0;
  begin_step(now_ns);
}

void InertialMotion::begin_step(TimeNs now_ns) {
  begun_ns_ = now_ns;
  X_WS_ = pose();
}

void InertialMotion::end_step(TimeNs now_ns, const Vector3d& gravity_W) {
  const double dt_s = seconds(now_ns - begun_ns_);
  if (dt_s <= 0.0) return;
  const Pose X_WS = pose();
  const Vector3d velocity_W = (X_WS.p - X_WS_.p) / dt_s;
  // The difference of two mean velocities is the acceleration at the instant between them, when the
  // axes were those of the step's beginning: exact to (w dt)^2 / 12 on a circle.
  const Eigen::Quaterniond q_SW = X_WS_.q.conjugate();
  sum_.acceleration += q_SW * (velocity_W - velocity_W_);
  sum_.gravity += dt_s * (q_SW * gravity_W);
  sum_.angular_velocity += rotation_vector(q_SW * X_WS.q);
  summed_s_ += dt_s;
  velocity_W_ = velocity_W;
}

InertialMotion::Mean InertialMotion::take() {
  if (summed_s_ <= 0.0) return {};
  const Mean mean{sum_.acceleration / summed_s_, sum_.gravity / summed_s_,
                  sum_.angular_velocity / summed_s_};
  sum_ = Mean{};
  summed_s_ = 0.0;
  return mean;
}

}  // namespace ardee::devices
