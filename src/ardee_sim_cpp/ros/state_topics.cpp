// SPDX-License-Identifier: MIT
#include "ros/state_topics.h"

#include <gazebo_msgs/LinkStates.h>
#include <gazebo_msgs/ModelStates.h>
#include <ros/node_handle.h>

#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr std::uint32_t kQueue = 10;

template <typename States>
void append(States& states, const std::string& name, const Pose& pose, const Twist& twist) {
  states.name.push_back(name);
  states.pose.push_back(to_ros(pose));
  states.twist.push_back(to_ros(twist));
}

}  // namespace

StateTopics::StateTopics(ros::NodeHandle& private_node, const Simulation& simulation)
    : simulation_(simulation),
      models_(private_node.advertise<gazebo_msgs::ModelStates>("model_states", kQueue)),
      links_(private_node.advertise<gazebo_msgs::LinkStates>("link_states", kQueue)) {}

void StateTopics::publish() {
  if (models_.getNumSubscribers() > 0) {
    gazebo_msgs::ModelStates states;
    for (const auto& entity : simulation_.entities()) {
      const devices::Robot& robot = *entity->robot;
      append(states, robot.name(), robot.pose(), robot.twist());
    }
    models_.publish(states);
  }
  if (links_.getNumSubscribers() > 0) {
    gazebo_msgs::LinkStates states;
    for (const auto& entity : simulation_.entities()) {
      const devices::Robot& robot = *entity->robot;
      for (std::size_t link = 0; link < robot.model().links.size(); ++link) {
        append(states, robot.name() + "::" + robot.model().links[link].name, robot.link_pose(link),
               robot.link_twist(link));
      }
    }
    links_.publish(states);
  }
}

}  // namespace ardee::node
