// SPDX-License-Identifier: MIT
#include "ros/clock_publisher.h"

#include <ros/node_handle.h>
#include <ros/single_subscriber_publisher.h>
#include <rosgraph_msgs/Clock.h>

#include "ros/conversions.h"

namespace ardee::node {
namespace {

constexpr std::uint32_t kQueue = 10;

rosgraph_msgs::Clock message(TimeNs now_ns) {
  rosgraph_msgs::Clock clock;
  clock.clock = to_ros(now_ns);
  return clock;
}

}  // namespace

ClockPublisher::ClockPublisher(double rate_hz) : timer_(rate_hz) {
  publisher_ = ros::NodeHandle().advertise<rosgraph_msgs::Clock>(
      "/clock", kQueue, [this](const ros::SingleSubscriberPublisher& newcomer) {
        newcomer.publish(message(now_ns_));
      });
}

void ClockPublisher::on_step(TimeNs now_ns) {
  now_ns_ = now_ns;
  if (timer_.due(now_ns)) publish(now_ns);
}

void ClockPublisher::publish(TimeNs now_ns) {
  now_ns_ = now_ns;
  publisher_.publish(message(now_ns));
}

void ClockPublisher::restart(TimeNs now_ns) {
  timer_.reset();
  timer_.start_at(now_ns);
  publish(now_ns);
}

}  // namespace ardee::node
