// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include "ardee_sim/devices/ports.h"

namespace ardee::node {

/// Hands a device what is said on the topic of one of its inputs. A message that the device does
/// not take changes nothing and is a warning, not more often than each few seconds. Throws Error if
/// the topic cannot be had.
ros::Subscriber subscribe(ros::NodeHandle& node, const devices::Input& input);

/// Throws Error if that is no name of a topic or service.
void require_valid(const std::string& topic);

}  // namespace ardee::node
