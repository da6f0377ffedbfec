// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <set>
#include <string>

namespace ardee {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Where the engine's messages go: a ROS node maps them to its own log, a test records them.
using LogSink = std::function<void(LogLevel, const std::string&)>;

/// The engine's log: a sink, and the memory that a message is given once. Copies share nothing but
/// the sink.
class Log {
 public:
  /// Without a sink, warnings and errors go to standard error.
  Log();
  explicit Log(LogSink sink) : sink_(std::move(sink)) {}

  void info(const std::string& text) { sink_(LogLevel::kInfo, text); }
  void warn(const std::string& text) { sink_(LogLevel::kWarning, text); }
  void error(const std::string& text) { sink_(LogLevel::kError, text); }
  /// The same text is given once in the life of this log.
  void warn_once(const std::string& text);

 private:
  LogSink sink_;
  std::set<std::string> given_;
};

}  // namespace ardee
