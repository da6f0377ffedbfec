// SPDX-License-Identifier: MIT
#include <sstream>

#include "ros/conversions.h"
#include "ros/reading_to_message.h"

namespace ardee::node {
namespace {

gazebo_msgs::ContactState to_state(const devices::ContactsReading::Touch& touch) {
  gazebo_msgs::ContactState state;
  state.collision1_name = touch.collision1;
  state.collision2_name = touch.collision2;
  physics::ForceTorque total;
  for (const physics::Contact& point : touch.points) {
    state.wrenches.push_back(to_ros(point.on1));
    state.contact_positions.push_back(to_vector(point.position));
    state.contact_normals.push_back(to_vector(point.normal));
    state.depths.push_back(point.depth_m);
    total.force += point.on1.force;
    total.torque += point.on1.torque;
  }
  state.total_wrench = to_ros(total);
  return state;
}

}  // namespace

gazebo_msgs::ContactsState to_message(const devices::ContactsReading& reading) {
  gazebo_msgs::ContactsState message;
  message.header = to_ros(reading.header);
  for (std::size_t i = 0; i < reading.touches.size(); ++i) {
    const devices::ContactsReading::Touch& touch = reading.touches[i];
    std::ostringstream info;  // as in the stock plugin
    info << "Debug:  i:(" << i << "/" << reading.touches.size()
         << ")     my geom:" << touch.collision1 << "   other geom:" << touch.collision2
         << "         time:" << to_ros(touch.time_ns) << "\n";
    message.states.push_back(to_state(touch));
    message.states.back().info = info.str();
  }
  return message;
}

geometry_msgs::WrenchStamped to_message(const devices::WrenchReading& reading) {
  geometry_msgs::WrenchStamped message;
  message.header = to_ros(reading.header);
  message.wrench = to_ros(reading.wrench);
  return message;
}

}  // namespace ardee::node
