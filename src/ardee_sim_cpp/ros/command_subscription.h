// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include "ardee_sim/devices/ports.h"

namespace ardee::node {

/// Subscribes to the topic of a device's input and passes the messages on. A message that the
/// device refuses changes nothing and is a warning, at most once in a few seconds. Throws Error if
/// the topic cannot be subscribed to.
ros::Subscriber subscribe(ros::NodeHandle& node, const devices::Input& input);

/// Throws Error if the text is not a valid name of a topic or service.
void require_valid(const std::string& topic);

}  // namespace ardee::node
