// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/core/error.h"

namespace ardee {

enum class LogLevel { kDebug, kInfo, kWarning, kError };

/// Receiver of the engine's messages: a ROS node maps them to its own log, a test records them.
using LogSink = std::function<void(LogLevel, const std::string&)>;

/// The engine's log: a sink, and a record of the messages that were given once. Copies share only
/// the sink.
class Log {
 public:
  /// Without a sink, warnings and errors go to standard error.
  Log();
  explicit Log(LogSink sink) : sink_(std::move(sink)) {}

  void info(const std::string& text) { sink_(LogLevel::kInfo, text); }
  void warn(const std::string& text) { add_warning(text, text); }
  /// Warns of a problem at a place in an input. Within a LogGroup one such warning stands for all
  /// with the same text about an element of the same name, even if the detail at its end (a name)
  /// differs.
  void warn(const Source& source, const std::string& what, const std::string& detail = "") {
    add_warning(source.element + ": " + what, source.to_string() + ": " + what + detail);
  }
  void error(const std::string& text) { sink_(LogLevel::kError, text); }
  /// Gives a text only once in the life of this log.
  void warn_once(const std::string& text);

 private:
  friend class LogGroup;

  struct Warning {
    std::string text;  // of the first of its kind
    std::size_t repeats = 0;
  };

  void add_warning(const std::string& kind, const std::string& text);
  void flush();

  LogSink sink_;
  std::set<std::string> given_;
  int groups_ = 0;
  std::vector<Warning> waiting_;
  std::unordered_map<std::string, std::size_t> waiting_by_kind_;
};

/// Collects a log's warnings while it lives, say for one file, and at its end gives each kind once:
/// the first warning, and the number of further ones. Groups nest; only the outermost one acts.
class LogGroup {
 public:
  explicit LogGroup(Log& log) : log_(log) { ++log_.groups_; }
  ~LogGroup() {
    if (--log_.groups_ == 0) log_.flush();
  }
  LogGroup(const LogGroup&) = delete;
  LogGroup& operator=(const LogGroup&) = delete;

 private:
  Log& log_;
};

}  // namespace ardee
