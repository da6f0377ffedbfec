// SPDX-License-Identifier: MIT
#pragma once

#include <ros/callback_queue.h>

namespace ardee::node {

/// Calls the callbacks that wait in the queue, or the first one that comes within `timeout_s` of
/// wall time. One of these callbacks may call it again.
void call_waiting(ros::CallbackQueue& queue, double timeout_s);

}  // namespace ardee::node
