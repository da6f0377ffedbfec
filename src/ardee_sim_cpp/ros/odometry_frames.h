// SPDX-License-Identifier: MIT
#pragma once

#include <tf2_msgs/TFMessage.h>

#include <functional>
#include <map>
#include <string>
#include <utility>

#include "ardee_sim/devices/reading.h"
#include "ardee_sim/devices/robot.h"

namespace ardee::node {

/// Joins the frame that a robot's odometry is given in to the frame `world`, on /tf_static, so that
/// markers in `world` and a robot below `odom` are seen together. The transform follows from the
/// first reading: the identity if odometry is the pose in the world, the starting pose if it comes
/// from the wheels.
class OdometryFrames {
 public:
  using Send = std::function<void(const tf2_msgs::TFMessage&)>;

  /// Publishes on /tf_static if enabled.
  explicit OdometryFrames(bool enabled);
  /// `send` gets all frames whenever one of them has changed.
  explicit OdometryFrames(Send send) : send_(std::move(send)) {}

  void on_reading(const devices::Robot& robot, const devices::OdometryReading& reading);
  void on_reading(const devices::Robot& robot, const devices::TransformReading& reading);
  template <typename Other>
  void on_reading(const devices::Robot&, const Other&) {}

  /// Stops publishing the frames of this robot.
  void forget(const std::string& robot_name);
  /// Learns the frames anew, after a restart of odometry.
  void restart() { frames_.clear(); }

 private:
  struct Frame {
    std::string robot_name;
    Pose X_WO;
  };
  void learn(const devices::Robot& robot, const devices::Header& header, const Pose& X_OB,
             bool planar);
  void publish();

  Send send_;  // none: disabled
  std::map<std::string, Frame> frames_;
};

}  // namespace ardee::node
