// SPDX-License-Identifier: MIT
#include "ros/waiting_callbacks.h"

namespace ardee::node {
namespace {

constexpr int kMostAtOnce = 1000;  // so that a continuous sender does not block the caller

}  // namespace

// One by one: callAvailable() within callAvailable() inserts into a deque of which roscpp (1.15)
// keeps an iterator, to the callback that the outer one calls next.
void call_waiting(ros::CallbackQueue& queue, double timeout_s) {
  ros::WallDuration timeout(timeout_s);
  for (int count = 0; count < kMostAtOnce; ++count) {
    if (queue.callOne(timeout) != ros::CallbackQueue::Called) return;
    timeout = ros::WallDuration(0.0);
  }
}

}  // namespace ardee::node
