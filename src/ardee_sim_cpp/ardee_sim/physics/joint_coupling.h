// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "ardee_sim/physics/body_states.h"
#include "ardee_sim/physics/model_joint.h"

namespace ardee::physics {

/// Coupling of a joint to the leader that it follows. An impulse (N m s or N s) on the follower,
/// and multiplier times that impulse in the opposite sense on the leader, hold them together.
class JointCoupling {
 public:
  JointCoupling(const Coupling& coupling, ModelJoint& leader, ModelJoint& follower)
      : coupling_(coupling), leader_(&leader), follower_(&follower) {}

  const ModelJoint* leader() const { return leader_; }
  /// Position of the follower that the leader's asks for.
  double wanted() const { return coupling_.multiplier * leader_->position() + coupling_.offset; }
  /// Excess of the follower's velocity after a step, given the positions before it.
  double excess(double step_s) const;
  void push(double impulse, double step_s) const;
  double clamp(double impulse, double step_s) const;
  /// Impulse of the last step.
  double impulse = 0.0;

 private:
  Coupling coupling_;
  ModelJoint* leader_;
  ModelJoint* follower_;
};

/// Takes a step after which all couplings hold. ODE has no constraint row for four bodies, but the
/// velocities after a step are linear in an impulse before it, as long as no contact appears, ends
/// or slips. The response to an impulse is therefore measured by a trial step, and scaled to remove
/// the remaining error.
void step_coupled(const std::vector<JointCoupling*>& couplings, const std::vector<dBodyID>& bodies,
                  double step_s, const std::function<void()>& step);

}  // namespace ardee::physics
