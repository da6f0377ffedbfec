// SPDX-License-Identifier: MIT
#include "ros/conversions.h"

#include "ardee_sim/core/error.h"

namespace ardee::node {

ros::Time to_ros(TimeNs time_ns) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(time_ns));
}

std_msgs::Header to_ros(const devices::Header& header) {
  std_msgs::Header message;
  message.stamp = to_ros(header.stamp_ns);
  message.frame_id = header.frame_id;
  return message;
}

geometry_msgs::Point to_point(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

geometry_msgs::Vector3 to_vector(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

geometry_msgs::Quaternion to_quaternion(const Eigen::Quaterniond& q) {
  geometry_msgs::Quaternion message;
  message.x = q.x();
  message.y = q.y();
  message.z = q.z();
  message.w = q.w();
  return message;
}

geometry_msgs::Pose to_ros(const Pose& pose) {
  geometry_msgs::Pose message;
  message.position = to_point(pose.p);
  message.orientation = to_quaternion(pose.q);
  return message;
}

geometry_msgs::Transform to_transform(const Pose& pose) {
  geometry_msgs::Transform message;
  message.translation = to_vector(pose.p);
  message.rotation = to_quaternion(pose.q);
  return message;
}

geometry_msgs::Wrench to_ros(const physics::ForceTorque& wrench) {
  geometry_msgs::Wrench message;
  message.force = to_vector(wrench.force);
  message.torque = to_vector(wrench.torque);
  return message;
}

geometry_msgs::Twist to_ros(const Twist& twist) {
  geometry_msgs::Twist message;
  message.linear = to_vector(twist.linear);
  message.angular = to_vector(twist.angular);
  return message;
}

Eigen::Vector3d from_ros(const geometry_msgs::Vector3& vector) {
  return {vector.x, vector.y, vector.z};
}

Eigen::Vector3d from_ros(const geometry_msgs::Point& point) { return {point.x, point.y, point.z}; }

Pose from_ros(const geometry_msgs::Pose& message) {
  constexpr double kSmallestNorm = 1e-9;
  Pose pose;
  pose.p = from_ros(message.position);
  pose.q = Eigen::Quaterniond(message.orientation.w, message.orientation.x, message.orientation.y,
                              message.orientation.z);
  if (!pose.is_finite()) throw Error("found a pose that is not finite");
  // Normalises twice, as the norm of a very long quaternion overflows.
  const double largest = pose.q.coeffs().cwiseAbs().maxCoeff();
  if (largest > 1.0) pose.q.coeffs() /= largest;
  if (pose.q.norm() < kSmallestNorm) {
    pose.q = Eigen::Quaterniond::Identity();
  } else {
    pose.q.normalize();
  }
  return pose;
}

physics::ForceTorque from_ros(const geometry_msgs::Wrench& wrench) {
  return {from_ros(wrench.force), from_ros(wrench.torque)};
}

Twist from_ros(const geometry_msgs::Twist& twist) {
  return {from_ros(twist.linear), from_ros(twist.angular)};
}

bool is_finite(const Twist& twist) { return twist.linear.allFinite() && twist.angular.allFinite(); }

devices::JointTrajectory from_ros(const trajectory_msgs::JointTrajectory& message) {
  devices::JointTrajectory trajectory;
  if (!message.header.stamp.isZero()) trajectory.start_s = message.header.stamp.toSec();
  trajectory.joints = message.joint_names;
  for (const auto& point : message.points) {
    trajectory.points.push_back({point.positions, point.velocities, point.accelerations,
                                 point.effort, point.time_from_start.toSec()});
  }
  return trajectory;
}

}  // namespace ardee::node
