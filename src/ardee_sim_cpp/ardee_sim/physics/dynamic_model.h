// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/physics/body_groups.h"
#include "ardee_sim/physics/collision_shape.h"
#include "ardee_sim/physics/joint_coupling.h"
#include "ardee_sim/physics/model_joint.h"
#include "ardee_sim/physics/ode_types.h"
#include "ardee_sim/physics/physics_world.h"

namespace ardee::physics {

/// A model as bodies and joints of ODE. Each group of links that fixed joints hold together is one
/// body, whose frame lies at its centre of mass, parallel to the model's frame when all joints are
/// at zero.
class DynamicModel : public PhysicsModel {
 public:
  struct Shape {
    CollisionShape shape;
    std::size_t group;
    std::size_t link;
  };
  using ShapePair = std::pair<std::size_t, std::size_t>;

  /// Throws Error and leaves nothing in the world if the description cannot be simulated.
  DynamicModel(dWorldID world, std::shared_ptr<const Model> model, const Pose& X_WM,
               ShapeFactory& factory, const std::string& name = "");

  const Model& description() const override { return *model_; }
  Pose pose() const override;
  void set_twist(const Twist& twist_W) override;
  void set_link_states(const LinkStates& states) override;
  void set_state(const Pose& X_WM, const Twist& twist_W) override;
  Pose link_pose(std::size_t link) const override;
  Twist link_twist(std::size_t link) const override;
  double joint_position(std::size_t joint) const override;
  double joint_velocity(std::size_t joint) const override;
  void set_joint_position(std::size_t joint, double position) override;
  void set_joint_motor(std::size_t joint, double velocity, double max_effort) override;
  void set_joint_spring(std::size_t joint, const JointSpring& spring) override;
  void set_joint_limits(std::size_t joint, double lower, double upper) override;
  const LinkProperties& link_properties(std::size_t link) const override { return links_.at(link); }
  void set_link_properties(std::size_t link, const LinkProperties& properties) override;
  std::size_t joint_axes(std::size_t joint) const override;
  const JointProperties& joint_properties(std::size_t joint, std::size_t axis) const override;
  void set_joint_properties(std::size_t joint, std::size_t axis,
                            const JointProperties& properties) override;
  void couple_joints(const Coupling& coupling) override;
  const JointMotor& joint_motor(std::size_t joint, std::size_t axis) const override;
  void set_joint_motor(std::size_t joint, std::size_t axis, const JointMotor& motor) override;
  void want_joint_wrench(std::size_t joint) override;
  ForceTorque joint_wrench(std::size_t joint) const override;
  void apply_wrench(std::size_t link, const Eigen::Vector3d& force_W,
                    const Eigen::Vector3d& point_W, const Eigen::Vector3d& torque_W) override;
  void apply_joint_effort(std::size_t joint, double effort) override;

  std::uint64_t rest() const override { return rest_; }

  const std::vector<Shape>& shapes() const { return shapes_; }
  /// Pairs of this model's own shapes that may touch.
  const std::vector<ShapePair>& self_pairs() const { return self_pairs_; }
  dBodyID body(std::size_t group) const { return bodies_[group].get(); }
  bool is_kinematic(std::size_t group) const { return groups_.groups[group].kinematic; }
  double mass_kg() const { return mass_kg_; }
  std::map<std::string, JointCoupling>& couplings() { return couplings_; }
  const std::vector<BodyHandle>& bodies() const { return bodies_; }
  /// An upper bound of the constraint rows of its joints.
  std::size_t rows() const { return rows_; }

  void prepare_step(const StepSettings& step, const Eigen::Vector3d& gravity_m_per_s2);
  void finish_step(double step_s);
  /// Whether the model has hardly moved for so long that it may be left out of steps.
  bool is_at_rest() const;
  /// Stops the model until it is woken.
  void fall_asleep(std::uint64_t rest);
  void wake();
  Eigen::AlignedBox3d bounds() const;
  /// Saves or restores all that steps and calls change. A restored model has just been made of its
  /// description.
  void serialize(StateArchive& state);
  /// Model, link and the limit of a valid state that it has left; empty if it has not.
  std::string state_fault() const;

 private:
  void make_bodies(dWorldID world, const Pose& X_WM);
  void make_shapes(ShapeFactory& factory);
  void make_joints(dWorldID world, const Pose& X_WM);
  void find_self_pairs();
  /// Orders the groups and finds the carrier of each, for turn_with_carriers.
  void order_carriers();
  /// Turns each body first with the body that carries it, then by its rate relative to that body.
  /// If both are summed first, as ODE does, a wheel of a turning robot leans out by half the
  /// product of both rates and the step, and then rolls on one edge.
  void turn_with_carriers(double step_s);
  std::size_t parent_group(const Joint& joint) const;
  std::size_t child_group(const Joint& joint) const;
  /// Groups that hang on the child side of a joint; throws Error if the parent is among them.
  std::vector<std::size_t> hanging_on(std::size_t joint) const;
  std::optional<std::size_t> index_of_joint(const std::string& name) const;
  /// Moves all that hangs on a joint; those that follow it stay.
  void place_joint(std::size_t joint, double position);
  ModelJoint* moving_joint(std::size_t joint) const { return joints_.at(joint).get(); }
  /// Throws Error if a motion would take the body out of the world.
  void check_motion(std::size_t group, const Pose& motion) const;
  void move_body(std::size_t group, const Pose& motion);
  /// Velocity of a body where the whole model, turned by `turn`, moves as one.
  Twist rigid_twist(std::size_t group, const Twist& twist_W, const Eigen::Quaterniond& turn) const;
  void set_velocities(const Twist& twist_W);
  void check_twist(const Twist& twist_W, const Eigen::Quaterniond& turn) const;
  /// Throws Error naming the joint if it has no such axis.
  JointDrive& drive(std::size_t joint, std::size_t axis) const;
  void set_mass(std::size_t group);
  /// Measures for how long the bodies have kept their places.
  void watch_rest(double step_s);
  /// Moves the frame of a body, but not its links, by an offset in its own axes.
  void shift_frame(std::size_t group, const Eigen::Vector3d& shift_B);

  std::shared_ptr<const Model> model_;
  std::string name_;
  std::vector<LinkProperties> links_;
  BodyGroups groups_;
  std::size_t canonical_ = 0;
  double mass_kg_ = 0.0;
  std::size_t rows_ = 0;
  std::vector<BodyHandle> bodies_;
  std::vector<Pose> X_BL_;                           // each link in its body
  std::vector<Shape> shapes_;                        // after the bodies that carry them
  std::vector<std::unique_ptr<ModelJoint>> joints_;  // null: fixed
  std::map<std::string, JointCoupling> couplings_;   // by follower
  std::vector<ShapePair> self_pairs_;
  LinkIndex link_index_;
  struct Carried {
    std::size_t group;
    std::size_t carrier;
  };
  std::vector<Carried> carried_;  // a carrier that is carried itself comes before what it carries
  std::vector<Eigen::Quaterniond> turns_;  // of each body in the last step
  bool may_rest_ = false;
  double still_s_ = 0.0;           // since a body last left its place in still_poses_
  std::vector<Pose> still_poses_;  // of each body
  std::uint64_t rest_ = 0;
};

}  // namespace ardee::physics
