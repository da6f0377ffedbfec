// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"

namespace ardee::node {

/// Sink that writes the engine's messages to ROS's log.
LogSink log_to_ros();

}  // namespace ardee::node
