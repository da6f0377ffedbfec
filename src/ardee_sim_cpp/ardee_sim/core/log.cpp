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

void Log::add_warning(const std::string& kind, const std::string& text) {
  if (groups_ == 0) {
    sink_(LogLevel::kWarning, text);
    return;
  }
  const auto [known, is_new] = waiting_by_kind_.emplace(kind, waiting_.size());
  if (is_new) {
    waiting_.push_back({text});
  } else {
    ++waiting_[known->second].repeats;
  }
}

void Log::flush() {
  for (const Warning& warning : waiting_) {
    const std::string more =
        warning.repeats > 0 ? " (and " + std::to_string(warning.repeats) + " more)" : "";
    sink_(LogLevel::kWarning, warning.text + more);
  }
  waiting_.clear();
  waiting_by_kind_.clear();
}

}  // namespace ardee
