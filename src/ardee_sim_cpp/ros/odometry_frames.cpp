// SPDX-License-Identifier: MIT
#include "ros/odometry_frames.h"

#include <ros/node_handle.h>

#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr char kWorldFrame[] = "world";
constexpr double kSame = 1e-6;  // m, rad: below this the two frames are one

/// Pose of the odometry's frame in the world, level, from the pose of one body in both.
Pose level_frame(const Pose& X_WB, const Pose& X_OB, bool planar) {
  const double turn = rpy_from_quaternion(X_WB.q).z() - rpy_from_quaternion(X_OB.q).z();
  Pose X_WO;
  X_WO.q = quaternion_from_rpy({0.0, 0.0, turn});
  X_WO.p = X_WB.p - X_WO.q * X_OB.p;
  if (planar) X_WO.p.z() = 0.0;
  const bool same = X_WO.p.norm() < kSame && X_WO.q.vec().norm() < kSame;
  return same ? Pose{} : X_WO;
}

}  // namespace

OdometryFrames::OdometryFrames(bool enabled) {
  if (!enabled) return;
  send_ = [publisher = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf_static", 10, true)](
              const tf2_msgs::TFMessage& message) { publisher.publish(message); };
}

void OdometryFrames::on_reading(const devices::Robot& robot,
                                const devices::OdometryReading& reading) {
  if (!reading.in_odometry_frame) return;
  // The height in odometry messages is 0 at any height of the robot.
  learn(robot, reading.header, reading.pose, true);
}

void OdometryFrames::on_reading(const devices::Robot& robot,
                                const devices::TransformReading& reading) {
  if (reading.in_odometry_frame) learn(robot, reading.header, reading.pose, false);
}

void OdometryFrames::learn(const devices::Robot& robot, const devices::Header& header,
                           const Pose& X_OB, bool planar) {
  if (!send_ || header.frame_id == kWorldFrame || frames_.count(header.frame_id) > 0) return;
  frames_[header.frame_id] = {robot.name(), level_frame(robot.pose(), X_OB, planar)};
  publish();
}

void OdometryFrames::forget(const std::string& robot_name) {
  for (auto frame = frames_.begin(); frame != frames_.end();) {
    frame = frame->second.robot_name == robot_name ? frames_.erase(frame) : std::next(frame);
  }
  if (send_) publish();
}

void OdometryFrames::publish() {
  tf2_msgs::TFMessage message;
  for (const auto& [name, frame] : frames_) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = kWorldFrame;
    transform.child_frame_id = name;
    transform.transform = to_transform(frame.X_WO);
    message.transforms.push_back(transform);
  }
  send_(message);
}

}  // namespace ardee::node
