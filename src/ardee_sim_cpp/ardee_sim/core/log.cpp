// SPDX-License-Identifier: MIT
#include "ardee_sim/core/log.h"

#include <iostream>

namespace ardee {

Log::Log()
    : sink_([](LogLevel level, const std::string& text) {
        if (level == LogLevel::kWarning) std::cerr << "warning: " << text << "\n";
        if (level == LogLevel::kError) std::cerr << "error: " << text << "\n";
      }) {}

void Log::warn_once(const std::string& text) {
  if (given_.insert(text).second) warn(text);
}

}  // namespace ardee
