// SPDX-License-Identifier: MIT
#include "ros/log_to_ros.h"

#include <ros/console.h>

namespace ardee::node {

LogSink log_to_ros() {
  return [](LogLevel level, const std::string& text) {
    switch (level) {
      case LogLevel::kDebug:
        ROS_DEBUG_STREAM(text);
        break;
      case LogLevel::kInfo:
        ROS_INFO_STREAM(text);
        break;
      case LogLevel::kWarning:
        ROS_WARN_STREAM(text);
        break;
      case LogLevel::kError:
        ROS_ERROR_STREAM(text);
        break;
    }
  };
}

}  // namespace ardee::node
