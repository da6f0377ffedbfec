// SPDX-License-Identifier: MIT Treatment of each element and attribute of URDF, and of <gazebo>
// blocks in it. docs/support.md is made from this.
#include "ardee_sim/readers/schema.h"

namespace ardee {
namespace {

using namespace treatments;

const std::vector<SchemaRow>& urdf_rows() {
  static const std::vector<SchemaRow> rows{
      {"robot", acts, "@name link joint material gazebo"},
      {"robot", acts, "transmission", "for libgazebo_ros_control.so"},
      {"robot", settled, "@version", "there is one URDF"},
      {"robot", no_effect, "sensor", "a <sensor> in a <gazebo> block measures"},
      {"gazebo", elsewhere, "@reference", "see the <gazebo> blocks"},
      {"link", acts, "@name inertial visual collision"},
      {"link", settled, "@type verbose", "of older tools, and for people"},
      {"link", no_effect, "self_collision_checking", "a <gazebo> block's <selfCollide> says that"},
      {"inertial", acts, "origin mass inertia"},
      {"visual", acts, "@name origin geometry material"},
      {"collision", acts, "@name origin geometry"},
      {"collision", settled, "verbose", "of older tools, and for people"},
      {"collision", no_effect, "contact_coefficients",
       "a <gazebo> block's <mu1> and so on say that"},
      {"origin", acts, "@xyz @rpy"},
      {"mass", acts, "@value"},
      {"inertia", acts, "@ixx @ixy @ixz @iyy @iyz @izz"},
      {"geometry", acts, "box cylinder sphere mesh", "another shape is refused"},
      {"box", acts, "@size"},
      {"cylinder", acts, "@radius @length"},
      {"sphere", acts, "@radius"},
      {"mesh", acts, "@filename @scale"},
      {"material", acts, "@name color texture"},
      {"color", acts, "@rgba"},
      {"texture", acts, "@filename"},
      {"joint", acts, "@name @type origin parent child axis dynamics limit mimic"},
      {"mimic", acts, "@joint @multiplier @offset"},
      {"joint", no_effect, "calibration", "encoders need none"},
      {"joint", acts, "safety_controller", "of libgazebo_ros_control.so's commands"},
      {"joint", no_effect, "hardwareInterface", "one in a <transmission> counts"},
      {"parent", acts, "@link"},
      {"child", acts, "@link"},
      {"axis", acts, "@xyz"},
      {"limit", acts, "@lower @upper @effort @velocity"},
      {"dynamics", acts, "@damping @friction @spring_stiffness @spring_reference"},
      {"safety_controller", acts, "@soft_lower_limit @soft_upper_limit @k_position @k_velocity"},
      {"transmission", acts, "@name type joint actuator", "one without them is left out"},
      {"transmission", settled, "@type", "the element <type> counts, as in ROS"},
      {"transmission", settled, "mechanicalReduction", "commands are those of the joint"},
      {"transmission/joint", acts, "@name"},
      {"transmission/joint", acts, "hardwareInterface",
       "the first: EffortJointInterface, VelocityJointInterface or PositionJointInterface"},
      {"transmission/joint", settled, "role offset mechanicalReduction",
       "commands are those of the joint"},
      {"actuator", acts, "@name"},
      {"actuator", settled, "hardwareInterface role mechanicalReduction motorTorqueConstant",
       "commands are those of the joint"},
  };
  return rows;
}

const std::vector<SchemaRow>& gazebo_rows() {
  static const std::vector<SchemaRow> rows{
      {"gazebo robot", acts, "@reference plugin joint static allow_auto_disable"},
      {"gazebo robot", acts, "selfCollide self_collide", "two names of one thing"},
      {"gazebo robot", no_effect, "enable_wind", "no wind blows", "false"},
      {"gazebo link", acts, "@reference sensor visual collision velocity_decay gravity kinematic"},
      {"gazebo link", acts, "mu mu1 mu2 fdir1 frictionCone slip1 slip2 kp kd",
       "of all collisions of the link; <mu> is <mu1>"},
      {"gazebo link", acts, "minDepth min_depth maxVel max_vel maxContacts max_contacts",
       "of all collisions of the link; two names each"},
      {"gazebo link", acts, "material", "of all visuals of the link"},
      {"gazebo link", acts, "selfCollide self_collide laserRetro laser_retro", "two names each"},
      {"gazebo link", acts, "turnGravityOff", "the opposite of <gravity>"},
      {"gazebo link", acts, "dampingFactor", "both numbers of <velocity_decay>"},
      {"gazebo link", no_effect, "enable_wind", "no wind blows", "false"},
      {"gazebo link", no_effect, "must_be_base_link", "joints say what is held", "false"},
      {"gazebo link", no_effect, "projector audio_sink audio_source battery light particle_emitter",
       "not supported in a link, left out"},
      {"gazebo joint", acts,
       "@reference stopCfm stop_cfm stopErp stop_erp springStiffness spring_stiffness "
       "springReference spring_reference",
       "two names each"},
      {"gazebo joint", acts, "provideFeedback provide_feedback",
       "on a fixed joint: its links stay two bodies, between which a sensor measures"},
      {"gazebo joint", acts, "physics", "its <ode><limit>"},
      {"gazebo joint", no_effect,
       "implicitSpringDamper implicit_spring_damper cfmDamping cfm_damping",
       "springs and dampers are implicit", "true"},
      {"gazebo joint", settled, "disableFixedJointLumping preserveFixedJoint",
       "links that are fixed to each other keep their names"},
      {"gazebo joint", no_effect, "fudgeFactor fudge_factor", "motors are exact at the stops", "0"},
      {"gazebo joint", no_effect, "initialJointPosition initial_joint_position",
       "a joint starts as the links stand; spawn_model -J sets it", "0"},
  };
  return rows;
}

}  // namespace

const Schema& urdf_schema() {
  static const Schema schema("URDF", urdf_rows());
  return schema;
}

const Schema& gazebo_schema() {
  static const Schema schema("URDF", gazebo_rows(), &sdf_schema());
  return schema;
}

}  // namespace ardee
