// SPDX-License-Identifier: MIT
#include <gazebo_msgs/GetLinkState.h>
#include <gazebo_msgs/SetLinkState.h>

#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

std::string get_state(ServiceContext& context, const gazebo_msgs::GetLinkStateRequest& request,
                      gazebo_msgs::GetLinkStateResponse& response) {
  require_link(context, request.link_name);
  frame_in_world(context, request.reference_frame, "reference_frame");
  const RelativeState state = context.simulation.state(request.link_name, request.reference_frame);
  response.link_state.link_name = request.link_name;
  response.link_state.reference_frame = request.reference_frame;
  response.link_state.pose = to_ros(state.pose);
  response.link_state.twist = to_ros(state.twist);
  return "GetLinkState: got state";
}

void set_state(ServiceContext& context, const gazebo_msgs::LinkState& wanted) {
  require_link(context, wanted.link_name);
  frame_in_world(context, wanted.reference_frame, "reference_frame");
  const RelativeState state{from_ros(wanted.pose), from_ros(wanted.twist)};
  if (!is_finite(state.twist)) throw Error("found a twist that is not finite");
  context.simulation.set_state(wanted.link_name, state, wanted.reference_frame);
}

}  // namespace

void add_link_state_services(ServiceServers& servers, ServiceContext& context) {
  servers.add<gazebo_msgs::GetLinkState>("get_link_state", "GetLinkState",
                                         [&context](const auto& request, auto& response) {
                                           return get_state(context, request, response);
                                         });
  servers.add<gazebo_msgs::SetLinkState>("set_link_state", "SetLinkState",
                                         [&context](const auto& request, auto&) {
                                           set_state(context, request.link_state);
                                           return "SetLinkState: success";
                                         });
  servers.listen<gazebo_msgs::LinkState>(
      "set_link_state", "SetLinkState",
      [&context](const auto& wanted) { set_state(context, wanted); });
}

}  // namespace ardee::node
