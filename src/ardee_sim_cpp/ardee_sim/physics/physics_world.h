// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/scenery.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/physics/contact.h"
#include "ardee_sim/physics/properties.h"

namespace ardee::physics {

/// The moving state of one dynamic model. Links and joints are addressed by their index in the
/// description. Links joined by fixed joints move as one body but keep their frames.
class PhysicsModel {
 public:
  virtual ~PhysicsModel() = default;

  virtual const Model& description() const = 0;
  /// Pose of the model's frame, carried by its canonical link.
  virtual Pose pose() const = 0;
  /// Gives each link the rigid velocity whose value at the model's origin is `twist_W` (world
  /// axes).
  virtual void set_twist(const Twist& twist_W) = 0;
  /// Puts links, and the links fixed to them, at the poses of a saved world; joints follow.
  virtual void set_link_states(const LinkStates& states) = 0;
  /// Moves the whole model, with its joints as they are, and sets its twist. Throws Error and
  /// changes neither if the pose or the twist is not valid.
  virtual void set_state(const Pose& X_WM, const Twist& twist_W) = 0;
  virtual Pose link_pose(std::size_t link) const = 0;
  /// Linear velocity of the link frame's origin and angular velocity, in world axes.
  virtual Twist link_twist(std::size_t link) const = 0;

  /// Angle (rad, continuous over turns) or displacement (m) of the joint's first axis.
  virtual double joint_position(std::size_t joint) const = 0;
  virtual double joint_velocity(std::size_t joint) const = 0;
  /// Moves the child side of the joint, with all links below it; limits are respected.
  virtual void set_joint_position(std::size_t joint, double position) = 0;
  /// Drives the joint towards `velocity` with at most `max_effort`; max_effort 0 lets it coast.
  /// Holds until changed.
  virtual void set_joint_motor(std::size_t joint, double velocity, double max_effort) = 0;
  /// Replaces the spring, damper of the description. Holds until changed.
  virtual void set_joint_spring(std::size_t joint, const JointSpring& spring) = 0;
  virtual void set_joint_limits(std::size_t joint, double lower, double upper) = 0;

  /// Asks, before a step, for the wrench of a joint. Throws Error naming a fixed joint that is not
  /// measured: its links are one body.
  virtual void want_joint_wrench(std::size_t joint) = 0;
  /// Wrench of the child on the joint in the last step, if it was asked for: about the joint's
  /// origin, in the world's axes, including all that acts along the joint's axes (stops, motor,
  /// spring, efforts).
  virtual ForceTorque joint_wrench(std::size_t joint) const = 0;

  // Properties hold until changed; at first they are those of the description. The setters throw
  // Error and change nothing if a number has no meaning or the body could not be simulated.
  virtual const LinkProperties& link_properties(std::size_t link) const = 0;
  /// Replaces the properties of a link. Poses and velocities of the links' frames stay as they are.
  virtual void set_link_properties(std::size_t link, const LinkProperties& properties) = 0;
  /// Number of axes that can be driven: 0 for a fixed or ball joint, 2 for a universal or revolute2
  /// joint, else 1.
  virtual std::size_t joint_axes(std::size_t joint) const = 0;
  virtual const JointProperties& joint_properties(std::size_t joint, std::size_t axis) const = 0;
  virtual void set_joint_properties(std::size_t joint, std::size_t axis,
                                    const JointProperties& properties) = 0;
  /// Couples a joint to a leader from now on and replaces its earlier coupling. Throws Error and
  /// changes nothing if one of the joints does not exist or has no axis.
  virtual void couple_joints(const Coupling& coupling) = 0;
  virtual const JointMotor& joint_motor(std::size_t joint, std::size_t axis) const = 0;
  virtual void set_joint_motor(std::size_t joint, std::size_t axis, const JointMotor& motor) = 0;

  /// Adds a force (N, world axes) at a world point and a torque (N m) for the next step only.
  virtual void apply_wrench(std::size_t link, const Eigen::Vector3d& force_W,
                            const Eigen::Vector3d& point_W, const Eigen::Vector3d& torque_W) = 0;
  /// Adds an effort along the joint's axis for the next step only.
  virtual void apply_joint_effort(std::size_t joint, double effort) = 0;

  /// Number of the model's present period of rest, unique in this world; 0 while it is awake. A
  /// model at rest is left out of steps until something touches it or one of the calls above
  /// changes it. One with sensors, plugins or a running motor stays awake.
  virtual std::uint64_t rest() const = 0;
};

/// A model that has left the limits of a valid state (core/limits.h), and the limit in question.
struct LostModel {
  PhysicsModel* model = nullptr;
  std::string why;
};

/// ODE behind plain data: dynamic models, and scenery in a uniform grid so that the cost of a step
/// does not depend on the size of the field.
class PhysicsWorld {
 public:
  PhysicsWorld(const PhysicsParams& params, Log log);
  ~PhysicsWorld();

  const PhysicsParams& params() const;
  /// Takes effect with the next step.
  void set_params(const PhysicsParams& params);

  /// Throws Error (singular inertia, unknown link in a joint, ...) and leaves nothing behind. The
  /// result of a step depends on the names of models and scenery, not on the order in which they
  /// were added; equal names keep that order.
  PhysicsModel& add_model(std::shared_ptr<const Model> model, const Pose& X_WM,
                          const std::string& name = "");
  void remove_model(PhysicsModel& model);

  using SceneryId = std::uint32_t;
  /// `placement_names` gives the scoped name of the model at each place; without it that is `name`.
  SceneryId add_scenery(const std::vector<Placement>& placements, const std::string& name = "",
                        const PlacementNames& placement_names = nullptr);
  void remove_scenery(SceneryId id);

  /// One step of params().step_s. Returns the models that have left the limits of a valid state; no
  /// further step is taken until they are gone. Throws Error if memory runs out.
  std::vector<LostModel> step();
  /// Asks for the contacts of the next step; without it they are not kept, at no cost.
  void want_contacts();
  /// Contacts of the last step, if they were asked for. Their order does not depend on the order of
  /// adding.
  const std::vector<Contact>& contacts() const;
  /// Counts of the last step.
  struct Stats {
    std::size_t models = 0;          // awake
    std::size_t contacts = 0;        // points of contact
    std::size_t scenery_tested = 0;  // bounds of scenery compared with a robot's
    std::size_t scenery_built = 0;   // static shapes alive near robots
    bool solved_directly = false;    // not by iterations
  };
  Stats stats() const;
  /// Resets the random number with which ODE's solver shuffles rows; called on each reset.
  void reset_random(std::uint64_t seed);
  /// Saves or restores what steps and calls change in the models, and the solver. When it restores,
  /// the models of the save have just been made of their descriptions. Steps from a restored state
  /// give the same bytes, unless the inertia of a link was changed after its first step: then the
  /// last bits may differ. Contacts of the last step are not part of it.
  void serialize(StateArchive& state);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ardee::physics
