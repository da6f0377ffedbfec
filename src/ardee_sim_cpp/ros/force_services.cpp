// SPDX-License-Identifier: MIT
#include <gazebo_msgs/ApplyBodyWrench.h>
#include <gazebo_msgs/ApplyJointEffort.h>
#include <gazebo_msgs/BodyRequest.h>
#include <gazebo_msgs/JointRequest.h>

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/limits.h"
#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

TimeNs start_time(const ServiceContext& context, const ros::Time& wanted) {
  return std::max(context.simulation.now_ns(), static_cast<TimeNs>(wanted.toNSec()));
}

/// The wrench is in the axes of the reference frame, and the force acts at reference_point in it.
/// In the world's axes the point is counted from the body's centre of mass, so that a request
/// without a point pushes without turning.
std::string apply_wrench(ServiceContext& context,
                         const gazebo_msgs::ApplyBodyWrenchRequest& request) {
  const LinkRef ref = require_link(context, request.body_name);
  if (!ref.entity.robot->is_dynamic()) throw Error("'" + request.body_name + "' does not move");
  const Pose X_WR = frame_in_world(context, request.reference_frame, "reference_frame").pose;
  const bool in_world = names_world(request.reference_frame);
  const Eigen::Vector3d point_R = from_ros(request.reference_point);
  const Pose X_WL = ref.entity.robot->link_pose(ref.link);
  const auto inertial = ref.entity.robot->dynamics().link_properties(ref.link).inertial;
  const Eigen::Vector3d center_L = inertial ? inertial->X_LI.p : Eigen::Vector3d::Zero().eval();

  Wrench wrench;
  wrench.robot = ref.entity.robot.get();
  wrench.link = ref.link;
  wrench.force_W = X_WR.q * from_ros(request.wrench.force);
  wrench.torque_W = X_WR.q * from_ros(request.wrench.torque);
  const Eigen::Vector3d point_W = in_world ? X_WL * center_L + point_R : X_WR * point_R;
  wrench.point_L = X_WL.inverse() * point_W;
  wrench.start_ns = start_time(context, request.start_time);
  wrench.duration_ns = request.duration.toNSec();
  context.simulation.wrenches().add(wrench);
  return "ApplyBodyWrench: wrench added";
}

std::string apply_effort(ServiceContext& context,
                         const gazebo_msgs::ApplyJointEffortRequest& request) {
  const JointRef ref = require_joint(context, request.joint_name);
  if (!(std::abs(request.effort) <= limits::kStrongest)) {
    throw Error("found an effort that is not finite or above 1e9 N m or N");
  }
  if (ref.entity.robot->dynamics().joint_axes(ref.joint) == 0) {
    throw Error("joint '" + request.joint_name +
                "' has no axis, expected one that moves along one");
  }
  context.simulation.joint_efforts().add({ref.entity.robot.get(), ref.joint, request.effort,
                                          start_time(context, request.start_time),
                                          request.duration.toNSec()});
  return "ApplyJointEffort: effort set";
}

}  // namespace

void add_force_services(ServiceServers& servers, ServiceContext& context) {
  servers.add<gazebo_msgs::ApplyBodyWrench>(
      "apply_body_wrench", "ApplyBodyWrench",
      [&context](const auto& request, auto&) { return apply_wrench(context, request); });
  servers.add<gazebo_msgs::BodyRequest>(
      "clear_body_wrenches", "ClearBodyWrenches", [&context](const auto& request, auto&) {
        const LinkRef ref = require_link(context, request.body_name);
        context.simulation.wrenches().clear(*ref.entity.robot, ref.link);
        return "";
      });
  servers.add<gazebo_msgs::ApplyJointEffort>(
      "apply_joint_effort", "ApplyJointEffort",
      [&context](const auto& request, auto&) { return apply_effort(context, request); });
  servers.add<gazebo_msgs::JointRequest>(
      "clear_joint_forces", "ClearJointForces", [&context](const auto& request, auto&) {
        const JointRef ref = require_joint(context, request.joint_name);
        context.simulation.joint_efforts().clear(*ref.entity.robot, ref.joint);
        return "";
      });
}

}  // namespace ardee::node
