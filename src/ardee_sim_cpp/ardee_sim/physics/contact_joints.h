// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/physics/collision_shape.h"
#include "ardee_sim/physics/contact.h"
#include "ardee_sim/physics/narrow_phase.h"
#include "ardee_sim/physics/ode_types.h"

namespace ardee::physics {

/// One side of a contact: a shape and the body that carries it, null for scenery.
struct ContactSide {
  const CollisionShape* shape = nullptr;
  dBodyID body = nullptr;
  double weight_n = 0.0;  // of the whole model
};

/// Contact parameters of two surfaces, combined as Gazebo Classic combines them: springs in series,
/// dampers in parallel, the smaller friction, restitution and threshold of the two. Depth and speed
/// of correction come from bodies, not from scenery: the smaller value of two bodies.
struct ContactParameters {
  double mu = 0.0;
  double mu2 = 0.0;
  bool friction_cone = false;
  double slip1 = 0.0;
  double slip2 = 0.0;
  double torsional_mu = 0.0;
  bool use_patch_radius = true;
  double patch_radius_m = 0.0;
  double surface_radius_m = 0.0;
  double erp = 0.0;
  double cfm = 0.0;
  double min_depth_m = 0.0;
  double max_push_m_per_s = 0.0;
  double restitution = 0.0;
  double bounce_threshold_m_per_s = 0.0;
};

/// Whether two surfaces touch at all, by their bitmasks.
bool meet(const Surface& a, const Surface& b);
/// Whether a contact of the two surfaces exerts no force.
bool is_forceless(const Surface& a, const Surface& b);

/// Force bound of a soft contact: always at least twice the weight of the lighter model, which
/// would sink for ever otherwise.
ContactParameters combine_surfaces(const ContactSide& a, const ContactSide& b,
                                   const PhysicsParams& params);

/// The contacts of one step.
class ContactJoints {
 public:
  explicit ContactJoints(dWorldID world);

  /// Collides two shapes and joins their bodies where they overlap. `a` has a body that moves.
  void collide(const ContactSide& a, const ContactSide& b, const PhysicsParams& params);
  void clear();
  std::size_t count() const { return count_; }
  /// Sets whether the contacts that are found from now on are reported.
  void set_told(bool told) { told_ = told; }
  /// Reported contacts, valid after the solver's step, in the order in which they were found.
  std::vector<Contact> contacts() const;

 private:
  /// A contact to report, and the solver's forces for it.
  struct Told {
    ContactSide a;
    ContactSide b;
    ContactPoint point;
    dJointFeedback feedback{};
  };

  void join(const ContactSide& a, const ContactSide& b, const ContactParameters& law, double step_s,
            const ContactPoint& point);

  dWorldID world_;
  JointGroupHandle group_;
  std::size_t count_ = 0;
  ContactPoints points_;
  bool told_ = false;
  std::deque<Told> to_tell_;  // the engine keeps addresses in it
};

}  // namespace ardee::physics
