// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "ardee_sim/physics/body_states.h"
#include "ardee_sim/physics/model_joint.h"

namespace ardee::physics {

/// One joint that follows another. What holds them together is an impulse (N m s or N s) on the
/// follower and, the multiplier's times as much, against the leader.
class JointCoupling {
 public:
  JointCoupling(const Coupling& coupling, ModelJoint& leader, ModelJoint& follower)
      : coupling_(coupling), leader_(&leader), follower_(&follower) {}

  /// What the follower's velocity is too high after a step from the positions before it.
  double excess(double step_s) const;
  void push(double impulse, double step_s) const;
  double clamp(double impulse, double step_s) const;
  /// Of the last step.
  double impulse = 0.0;

 private:
  Coupling coupling_;
  ModelJoint* leader_;
  ModelJoint* follower_;
};

/// Takes a step such that couplings hold after it. ODE has no row for four bodies, but the
/// velocities after a step are linear in an impulse before it, as long as no contact comes, goes or
/// slips: they are measured by trial, and what is left is taken away by the same measure.
void step_coupled(const std::vector<JointCoupling*>& couplings, const std::vector<dBodyID>& bodies,
                  double step_s, const std::function<void()>& step);

}  // namespace ardee::physics
