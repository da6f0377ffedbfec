// SPDX-License-Identifier: MIT
#pragma once

#include <ros/callback_queue.h>

namespace ardee::node {

/// Calls what waits in the queue, or the first that comes within `timeout_s` of wall time. It may
/// be called from one of these callbacks.
void call_waiting(ros::CallbackQueue& queue, double timeout_s);

}  // namespace ardee::node
