// SPDX-License-Identifier: MIT
#include "ardee_sim/tools/node_interface.h"

namespace ardee {

const std::vector<NodeService>& node_services() {
  static const std::vector<NodeService> services{
      {"/gazebo/spawn_urdf_model", "gazebo_msgs/SpawnModel", "takes URDF and SDF"},
      {"/gazebo/spawn_sdf_model", "gazebo_msgs/SpawnModel",
       "takes SDF and URDF, also an SDF with a light and no model"},
      {"/gazebo/delete_model", "gazebo_msgs/DeleteModel", ""},
      {"/gazebo/get_model_state", "gazebo_msgs/GetModelState", ""},
      {"/gazebo/set_model_state", "gazebo_msgs/SetModelState", ""},
      {"/gazebo/set_model_configuration", "gazebo_msgs/SetModelConfiguration",
       "joint positions, all or none"},
      {"/gazebo/get_link_state", "gazebo_msgs/GetLinkState", ""},
      {"/gazebo/set_link_state", "gazebo_msgs/SetLinkState",
       "a link is moved with its whole model, joints as they are"},
      {"/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties", ""},
      {"/gazebo/get_model_properties", "gazebo_msgs/GetModelProperties", ""},
      {"/gazebo/get_link_properties", "gazebo_msgs/GetLinkProperties", ""},
      {"/gazebo/set_link_properties", "gazebo_msgs/SetLinkProperties",
       "mass, centre of mass, inertia, gravity"},
      {"/gazebo/get_joint_properties", "gazebo_msgs/GetJointProperties", ""},
      {"/gazebo/set_joint_properties", "gazebo_msgs/SetJointProperties",
       "`erp` and `fudge_factor` have no effect, which the answer says"},
      {"/gazebo/get_light_properties", "gazebo_msgs/GetLightProperties", ""},
      {"/gazebo/set_light_properties", "gazebo_msgs/SetLightProperties", ""},
      {"/gazebo/delete_light", "gazebo_msgs/DeleteLight", ""},
      {"/gazebo/get_physics_properties", "gazebo_msgs/GetPhysicsProperties", ""},
      {"/gazebo/set_physics_properties", "gazebo_msgs/SetPhysicsProperties",
       "`auto_disable_bodies`, `sor_pgs_precon_iters` and `sor_pgs_rms_error_tol` have no effect, "
       "and one warning says so"},
      {"/gazebo/set_parameters", "dynamic_reconfigure/Reconfigure", "of the physics"},
      {"/gazebo/pause_physics", "std_srvs/Empty", ""},
      {"/gazebo/unpause_physics", "std_srvs/Empty", ""},
      {"/gazebo/reset_world", "std_srvs/Empty",
       "models and what services changed of them, not the clock"},
      {"/gazebo/reset_simulation", "std_srvs/Empty", "models, clock and random numbers"},
      {"/gazebo/apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", ""},
      {"/gazebo/clear_body_wrenches", "gazebo_msgs/BodyRequest", ""},
      {"/gazebo/apply_joint_effort", "gazebo_msgs/ApplyJointEffort", ""},
      {"/gazebo/clear_joint_forces", "gazebo_msgs/JointRequest", ""},
      {"/ardee/set_light", "ardee_msgs/SetLight", "of sun and sky"},
      {"/ardee/step", "ardee_msgs/Step", "takes steps of a paused simulation"},
  };
  return services;
}

const std::vector<NodeTopic>& node_topics() {
  static const std::vector<NodeTopic> topics{
      {"/clock", "rosgraph_msgs/Clock", true, ""},
      {"/gazebo/model_states", "gazebo_msgs/ModelStates", true, "while somebody listens"},
      {"/gazebo/link_states", "gazebo_msgs/LinkStates", true, "while somebody listens"},
      {"/gazebo/performance_metrics", "gazebo_msgs/PerformanceMetrics", true,
       "while somebody listens"},
      {"/gazebo/parameter_descriptions", "dynamic_reconfigure/ConfigDescription", true,
       "of the physics, latched"},
      {"/gazebo/parameter_updates", "dynamic_reconfigure/Config", true, "of the physics, latched"},
      {"/tf_static", "tf2_msgs/TFMessage", true,
       "`world` to a robot's odometry frame, where `~publish_world_tf` asks for it"},
      {"/ardee/scenery", "visualization_msgs/MarkerArray", true, "for rviz, latched"},
      {"/gazebo/set_model_state", "gazebo_msgs/ModelState", false,
       "as the service, without an answer"},
      {"/gazebo/set_link_state", "gazebo_msgs/LinkState", false,
       "as the service, without an answer"},
  };
  return topics;
}

}  // namespace ardee
