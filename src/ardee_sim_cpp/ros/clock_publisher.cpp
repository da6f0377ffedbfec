// SPDX-License-Identifier: MIT
#include "ros/clock_publisher.h"

#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>

#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr std::uint32_t kQueue = 10;
// Bounds the messages to subscribers of a simulation that runs far ahead of real time.
constexpr auto kShortestPause = std::chrono::microseconds(500);

}  // namespace

ClockPublisher::ClockPublisher(double rate_hz) : timer_(rate_hz) {
  publisher_ = ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", kQueue);
}

void ClockPublisher::on_step(TimeNs now_ns) {
  if (timer_.due(now_ns) && Clock::now() >= earliest_) publish(now_ns);
}

void ClockPublisher::publish(TimeNs now_ns) {
  rosgraph_msgs::Clock clock;
  clock.clock = to_ros(now_ns);
  publisher_.publish(clock);
  earliest_ = Clock::now() + kShortestPause;
}

void ClockPublisher::restart(TimeNs now_ns) {
  timer_.start_at(now_ns);
  publish(now_ns);
}

}  // namespace ardee::node
