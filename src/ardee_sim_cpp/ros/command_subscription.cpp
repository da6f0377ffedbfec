// SPDX-License-Identifier: MIT
#include "ros/command_subscription.h"

#include <four_wheel_steering_msgs/FourWheelSteering.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Wrench.h>
#include <ros/console.h>
#include <ros/names.h>
#include <ros/topic_manager.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Empty.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <iterator>

#include "ardee_sim/core/error.h"
#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr std::uint32_t kQueue = 10;
constexpr double kWarningPeriod_s = 5.0;

/// Warns at once, and then not again for some wall time. ROS's own throttle counts simulated time,
/// and stays silent in its first seconds.
class ThrottledWarning {
 public:
  void say(const std::string& text) {
    const ros::WallTime now = ros::WallTime::now();
    if (!last_.isZero() && (now - last_).toSec() < kWarningPeriod_s) return;
    last_ = now;
    ROS_WARN_STREAM(text);
  }

 private:
  ros::WallTime last_;
};

devices::Command to_command(const std_msgs::Empty&) { return devices::Trigger{}; }
devices::Command to_command(const geometry_msgs::Twist& message) { return from_ros(message); }
devices::Command to_command(const std_msgs::Float64& message) { return message.data; }
devices::Command to_command(const std_msgs::Bool& message) { return message.data != 0; }
devices::Command to_command(const std_msgs::Float64MultiArray& message) {
  return std::vector<double>(message.data.begin(), message.data.end());
}
devices::Command to_command(const four_wheel_steering_msgs::FourWheelSteering& message) {
  return devices::SteeringCommand{message.front_steering_angle, message.rear_steering_angle,
                                  message.speed};
}
devices::Command to_command(const trajectory_msgs::JointTrajectory& message) {
  return from_ros(message);
}

devices::Command to_command(const geometry_msgs::Wrench& message) { return from_ros(message); }

void check_publishers(const devices::Input& input) {
  if (!input.needs_one_publisher) return;
  const std::size_t count = ros::TopicManager::instance()->getNumPublishers(input.topic);
  if (count > 1) throw Error("found " + std::to_string(count) + " publishers, expected one");
}

template <typename Message>
ros::Subscriber subscribe_to(ros::NodeHandle& node, const devices::Input& input) {
  boost::function<void(const boost::shared_ptr<const Message>&)> on_message =
      [input,
       complaint = ThrottledWarning()](const boost::shared_ptr<const Message>& message) mutable {
        try {
          check_publishers(input);
          input.on_command(to_command(*message));
        } catch (const std::exception& error) {
          complaint.say(input.topic + ": " + error.what() + "; the message is ignored");
        }
      };
  ros::Subscriber subscriber = node.subscribe<Message>(
      input.topic, kQueue, on_message, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  if (!subscriber) {
    throw Error("topic " + input.topic + " is already subscribed to with another type");
  }
  return subscriber;
}

}  // namespace

void require_valid(const std::string& topic) {
  std::string why;
  if (!ros::names::validate(topic, why)) {
    throw Error("found '" + topic + "' as a topic or service, expected a valid name: " + why);
  }
}

ros::Subscriber subscribe(ros::NodeHandle& node, const devices::Input& input) {
  require_valid(input.topic);
  using Subscribe = ros::Subscriber (*)(ros::NodeHandle&, const devices::Input&);
  constexpr Subscribe kSubscribe[] = {// in the order of Command
                                      subscribe_to<std_msgs::Empty>,
                                      subscribe_to<geometry_msgs::Twist>,
                                      subscribe_to<std_msgs::Float64>,
                                      subscribe_to<std_msgs::Bool>,
                                      subscribe_to<std_msgs::Float64MultiArray>,
                                      subscribe_to<four_wheel_steering_msgs::FourWheelSteering>,
                                      subscribe_to<trajectory_msgs::JointTrajectory>,
                                      subscribe_to<geometry_msgs::Wrench>};
  static_assert(std::size(kSubscribe) == std::variant_size_v<devices::Command>,
                "one a kind of command");
  return kSubscribe[input.kind](node, input);
}

}  // namespace ardee::node
