// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/core/log.h"

namespace ardee::node {

/// Passes the engine's messages on; a service can record the warnings that occur during a request.
class MessageTap {
 public:
  explicit MessageTap(LogSink next) : next_(std::move(next)) {}
  MessageTap(const MessageTap&) = delete;
  MessageTap& operator=(const MessageTap&) = delete;

  /// The tap outlives the sink.
  LogSink sink() {
    return [this](LogLevel level, const std::string& text) { pass(level, text); };
  }

  /// Records the warnings and errors that pass while it lives, in order. Only one exists at a time.
  class Kept {
   public:
    explicit Kept(MessageTap& tap) : tap_(tap) { tap_.kept_ = &texts_; }
    ~Kept() { tap_.kept_ = nullptr; }
    Kept(const Kept&) = delete;
    Kept& operator=(const Kept&) = delete;

    const std::vector<std::string>& texts() const { return texts_; }

   private:
    MessageTap& tap_;
    std::vector<std::string> texts_;
  };

 private:
  void pass(LogLevel level, const std::string& text) {
    next_(level, text);
    if (kept_ && (level == LogLevel::kWarning || level == LogLevel::kError)) kept_->push_back(text);
  }

  LogSink next_;
  std::vector<std::string>* kept_ = nullptr;
};

}  // namespace ardee::node
