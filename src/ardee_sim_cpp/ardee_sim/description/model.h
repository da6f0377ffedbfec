// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/element.h"
#include "ardee_sim/description/geometry.h"
#include "ardee_sim/description/material.h"

namespace ardee {

/// Contact properties of a body's surface. Friction as in ODE: mu along fdir1 (or the first axis of
/// the friction pyramid), mu2 across it. kp (N/m) and kd (N s/m) are the contact's spring and
/// damper. Defaults: SDF 1.6.
struct Surface {
  double mu = 1.0;
  double mu2 = 1.0;
  Eigen::Vector3d fdir1{0, 0, 0};  // in the collision's frame; zero: none
  bool friction_cone = true;       // false: ODE's pyramid, whose axes slide independently
  double slip1 = 0.0;
  double slip2 = 0.0;
  double kp_n_per_m = 1e12;
  double kd_n_s_per_m = 1.0;
  double max_correcting_velocity_m_per_s = 0.01;  // negative: unlimited
  double min_depth_m = 0.0;                       // not positive: not set
  double restitution = 0.0;
  double bounce_threshold_m_per_s = 1e5;
  int max_contacts = 10;
  // Two surfaces collide if the category of one and the mask of the other share a bit.
  std::uint32_t collide_bitmask = 0xFFFF;
  std::uint32_t category_bitmask = 0xFFFF;
  // Friction against turning on the spot: that of a round patch of this radius, or of the patch
  // that a surface of this radius has at the depth of the contact.
  double torsional_mu = 1.0;
  bool use_patch_radius = true;
  double patch_radius_m = 0.0;
  double surface_radius_m = 0.0;
  bool collide_without_contact = false;  // no force acts where it touches
};

struct Collision {
  std::string name;
  Pose X_LC;
  Geometry geometry;
  Surface surface;
  double laser_retro = 0.0;
};

struct Visual {
  std::string name;
  Pose X_LV;
  Geometry geometry;
  std::optional<Material> material;  // none: the mesh file's own, or grey
  bool cast_shadows = true;
  double transparency = 0.0;
  double laser_retro = 0.0;
};

/// Mass and inertia about the centre of mass, in the axes of X_LI.
struct Inertial {
  double mass_kg = 0.0;
  Pose X_LI;
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();

  void serialize(StateArchive& state) { state(mass_kg, X_LI, inertia_kg_m2); }
};

/// A plugin block as written; the registry that knows `filename` reads `element`.
struct PluginDescription {
  std::string name;
  std::string filename;
  Element element;
  std::string scope = "";  // "arm::" of a nested model; link names lack it
};

/// A <sensor> as written: the keys that all kinds share, and `element`, from which the sensor's own
/// parser reads the rest.
struct SensorDescription {
  std::string name;
  std::string type;
  double update_rate_hz = 0.0;
  Pose X_LS;
  Element element;
  std::vector<PluginDescription> plugins;
};

struct Link {
  std::string name;
  Pose X_ML;
  std::optional<Inertial> inertial;  // none: massless (URDF); the SDF reader fills in SDF's default
  std::vector<Collision> collisions;
  std::vector<Visual> visuals;
  std::vector<SensorDescription> sensors;
  bool gravity = true;
  bool kinematic = false;
  bool self_collide = false;
  // Share of the velocity that a step takes away above 0.01 m/s or rad/s, as in ODE (SDF
  // <velocity_decay>, URDF <dampingFactor>).
  double linear_decay = 0.0;
  double angular_decay = 0.0;
  Source source;
};

enum class JointType {
  kFixed,
  kRevolute,
  kContinuous,
  kPrismatic,
  kBall,
  kUniversal,
  kRevolute2,
  kScrew
};

/// Number of axes: 0, 1 or 2.
std::size_t axis_count(JointType type);
/// Whether the joint's only motion is a turn about its first axis.
bool turns(JointType type);
/// Whether the position along the first axis has limits.
bool has_limits(JointType type);
inline bool has_one_axis(JointType type) { return axis_count(type) == 1; }

/// One axis of a joint, with the limits and forces that act along it. SI units: rad or m, N m or N.
struct JointAxis {
  Eigen::Vector3d axis{0, 0, 1};  // unit, in the joint's frame
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double effort = std::numeric_limits<double>::infinity();
  double velocity = std::numeric_limits<double>::infinity();
  double damping = 0.0;
  double friction = 0.0;
  double spring_stiffness = 0.0;
  double spring_reference = 0.0;
};

/// Soft limits, inside the joint's limits, that ros_control enforces (URDF <safety_controller>):
/// the velocity is at most k_position (1/s) times the distance to the soft limit, and the effort at
/// most k_velocity (N m s/rad or N s/m) times the difference between that bound and the velocity.
struct SafetyLimits {
  double soft_lower = 0.0;
  double soft_upper = 0.0;
  double k_position = 0.0;
  double k_velocity = 0.0;
};

struct Joint {
  std::string name;
  JointType type = JointType::kFixed;
  std::string parent;  // link name, or "world"
  std::string child;
  Pose X_CJ;  // joint frame in the child link's frame
  JointAxis axis;
  JointAxis axis2;              // universal, revolute2
  double thread_pitch_m = 0.0;  // screw: metres a turn
  /// Whether a fixed joint reports its wrench: its links then stay two bodies.
  bool is_measured = false;
  // ODE's softness (CFM) and correction (ERP) at the stops and of the joint itself (negative: the
  // world's).
  double stop_cfm = -1.0;
  double stop_erp = -1.0;
  std::optional<SafetyLimits> safety;
  Source source;
};

/// Command interfaces that ros_control gives a joint (URDF <transmission>).
struct Transmission {
  std::string name;
  std::string joint;
  std::vector<std::string> interfaces;  // as written: "hardware_interface/EffortJointInterface"
  Source source;
};

/// Coupling by which one joint follows another under any load: position of the follower =
/// multiplier * position of the leader + offset, of their first axes (rad or m).
struct Coupling {
  std::string leader;
  std::string follower;
  double multiplier = 1.0;
  double offset = 0.0;
  double max_effort = std::numeric_limits<double>::infinity();  // of the follower
  Source source;
};

/// A frame of a model that others may refer to, and the link that it moves with.
struct NamedFrame {
  std::string name;
  Pose X_MF;
  std::string link;       // empty: the canonical one
  bool is_model = false;  // of a nested model that was merged into this one
};

struct Model;

/// Pose of a link in the world and velocity of its origin, in the world's axes.
struct LinkState {
  Pose X_WL;
  Twist twist_W;
};
using LinkStates = std::map<std::string, LinkState>;  // by link

/// A model placed somewhere: many instances share one description.
struct Instance {
  std::shared_ptr<const Model> model;
  std::string name;
  Pose pose;  // in the frame of its parent
  double scale = 1.0;
  std::uint32_t label = 0;  // class for segmentation; 0: none
  bool is_static = false;
  /// Initial states of a moving model's links, if they differ from the description at rest (a saved
  /// world).
  std::shared_ptr<const LinkStates> link_states = nullptr;
};

/// A model as described: const after load, shared by its instances.
struct Model {
  std::string name;
  Source source;
  bool is_static = false;
  bool self_collide = false;
  bool allow_auto_disable = true;  // physics may leave it out of steps while it is at rest
  Pose own_pose;  // <pose> of its own file, which an include replaces and a spawn composes with
  std::optional<Pose> X_MP;  // the frame that a <pose> of the model places; none: its own
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Transmission> transmissions;
  std::vector<Coupling> couplings;
  std::vector<PluginDescription> plugins;
  std::vector<Instance> instances;  // static models included by this one; non-static ones are
                                    // merged into links and joints
  std::vector<NamedFrame> frames;
  std::string canonical_link;  // the link whose pose stands for the model's; the first

  const Link* find_link(const std::string& link_name) const;
  const Joint* find_joint(const std::string& joint_name) const;
  /// Looks up the frame of a link or joint, or a named frame, with the link that it moves with;
  /// also the frame of a nested static model or of one of its parts ("shed::door").
  std::optional<NamedFrame> find_frame(const std::string& frame_name) const;
};

}  // namespace ardee
