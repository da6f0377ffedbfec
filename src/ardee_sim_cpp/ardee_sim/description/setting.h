// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

namespace ardee {

/// A parameter as a YAML file gives it to ROS's parameter server: a tree that keeps integers apart
/// from numbers with a point. Readers throw Error with the path of the parameter.
class Setting {
 public:
  using List = std::vector<Setting>;
  using Map = std::map<std::string, Setting>;
  using Value = std::variant<std::monostate, bool, int, double, std::string, List, Map>;

  Setting() = default;
  /// `path` is the full name, for messages: "/robot/base/wheel_radius".
  Setting(std::string path, Value value) : path_(std::move(path)), value_(std::move(value)) {}

  const std::string& path() const { return path_; }
  const Value& value() const { return value_; }
  /// Whether the parameter exists.
  explicit operator bool() const { return !std::holds_alternative<std::monostate>(value_); }
  /// The parameter below this one, by name or path ("linear/x"); if there is none, a setting that
  /// does not exist.
  Setting at(const std::string& relative_path) const;
  bool has(const std::string& relative_path) const { return static_cast<bool>(at(relative_path)); }

  // Values that roscpp's getParam accepts: a number may be written without a point, nothing else is
  // converted. Without a fallback the parameter is required.
  double number(const std::string& name) const;
  double number(const std::string& name, double fallback) const;
  int integer(const std::string& name, int fallback) const;
  bool boolean(const std::string& name, bool fallback) const;
  std::string text(const std::string& name) const;
  std::string text(const std::string& name, const std::string& fallback) const;
  /// This setting, which is a list or a group; `expected` describes it in the message.
  const List& list(const std::string& expected) const;
  const Map& group(const std::string& expected) const;
  /// A list of names.
  std::vector<std::string> texts(const std::string& name) const;
  /// A list of `count` numbers that all have a point, as controllers read their covariances.
  std::vector<double> exact_doubles(const std::string& name, std::size_t count) const;

 private:
  std::string path_;
  Value value_;
};

}  // namespace ardee
