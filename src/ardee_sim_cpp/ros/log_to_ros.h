// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"

namespace ardee::node {

/// The engine's messages in ROS's log.
LogSink log_to_ros();

}  // namespace ardee::node
