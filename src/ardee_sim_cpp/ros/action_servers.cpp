// SPDX-License-Identifier: MIT
#include "ros/action_servers.h"

#include <actionlib/server/action_server.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <control_msgs/GripperCommandAction.h>

#include <algorithm>
#include <string>
#include <variant>

#include "ros/command_subscription.h"
#include "ros/conversions.h"
#include "ros/reading_to_message.h"

namespace ardee::node {
namespace {

devices::JointTolerance from_ros(const control_msgs::JointTolerance& message) {
  return {message.name, message.position, message.velocity, message.acceleration};
}

devices::FollowTrajectoryGoal from_ros(const control_msgs::FollowJointTrajectoryGoal& message) {
  devices::FollowTrajectoryGoal goal;
  goal.trajectory = node::from_ros(message.trajectory);
  for (const auto& each : message.path_tolerance) goal.path_tolerances.push_back(from_ros(each));
  for (const auto& each : message.goal_tolerance) goal.goal_tolerances.push_back(from_ros(each));
  goal.goal_time_tolerance_s = message.goal_time_tolerance.toSec();
  return goal;
}

devices::GripperGoal from_ros(const control_msgs::GripperCommandGoal& message) {
  return {message.command.position, message.command.max_effort};
}

void fill(const devices::FollowTrajectoryResult& result,
          control_msgs::FollowJointTrajectoryResult& message) {
  message.error_code = result.code;
  message.error_string = result.text;
}

void fill(const devices::TrajectoryControllerReading& reading,
          control_msgs::FollowJointTrajectoryFeedback& message) {
  const control_msgs::JointTrajectoryControllerState state = to_message(reading);
  message.header = state.header;
  message.joint_names = state.joint_names;
  message.desired = state.desired;
  message.actual = state.actual;
  message.error = state.error;
}

/// Converts a result or feedback.
template <typename Message>
void fill(const devices::GripperState& state, Message& message) {
  message.position = state.position;
  message.effort = state.effort;
  message.stalled = state.is_stalled;
  message.reached_goal = state.has_reached_goal;
}

/// One action, of the type `Spec` of ROS.
template <typename Action, typename Spec>
class Server {
 public:
  Server(const ros::NodeHandle& node, const Action& action)
      : action_(action),
        server_(
            node, action.name, [this](RosGoal goal) { on_goal(goal); },
            [this](RosGoal goal) { on_cancel(goal); }, false) {
    server_.start();
  }

 private:
  ACTION_DEFINITION(Spec)
  using RosGoal = actionlib::ServerGoalHandle<Spec>;

  class Handle : public Action::Handle {
   public:
    explicit Handle(const RosGoal& goal) : goal_(goal) {}
    bool is(const RosGoal& goal) const { return goal_ == goal; }

    void accept() override { goal_.setAccepted(); }
    void reject(const typename Action::Result& result, const std::string& why) override {
      goal_.setRejected(message<Result>(result), why);
    }
    void feed_back(const typename Action::Feedback& feedback) override {
      goal_.publishFeedback(message<Feedback>(feedback));
    }
    void succeed(const typename Action::Result& result) override {
      goal_.setSucceeded(message<Result>(result));
    }
    void abort(const typename Action::Result& result) override {
      goal_.setAborted(message<Result>(result));
    }
    void cancel() override { goal_.setCanceled(); }

   private:
    template <typename Message, typename Content>
    static Message message(const Content& content) {
      Message filled;
      fill(content, filled);
      return filled;
    }

    RosGoal goal_;
  };

  void on_goal(RosGoal& goal) {
    const auto handle = std::make_shared<Handle>(goal);
    handles_.erase(std::remove_if(handles_.begin(), handles_.end(),
                                  [](const auto& each) { return each.expired(); }),
                   handles_.end());
    handles_.push_back(handle);
    action_.on_goal(from_ros(*goal.getGoal()), handle);
  }

  void on_cancel(const RosGoal& goal) {
    const auto handles = handles_;  // the calls may change them
    for (const auto& each : handles) {
      const auto handle = each.lock();
      if (handle && handle->is(goal)) action_.on_cancel(handle);
    }
  }

  const Action& action_;
  std::vector<std::weak_ptr<Handle>> handles_;  // owned by the controller
  actionlib::ActionServer<Spec> server_;
};

std::shared_ptr<void> serve(const ros::NodeHandle& node,
                            const devices::FollowTrajectoryAction& action) {
  return std::make_shared<
      Server<devices::FollowTrajectoryAction, control_msgs::FollowJointTrajectoryAction>>(node,
                                                                                          action);
}
std::shared_ptr<void> serve(const ros::NodeHandle& node, const devices::GripperAction& action) {
  return std::make_shared<Server<devices::GripperAction, control_msgs::GripperCommandAction>>(
      node, action);
}

}  // namespace

void ActionServers::add(const ros::NodeHandle& node, const devices::Action& action) {
  std::visit(
      [&](const auto& each) {
        require_valid(each.name);
        servers_.push_back(serve(node, each));
      },
      action);
}

}  // namespace ardee::node
