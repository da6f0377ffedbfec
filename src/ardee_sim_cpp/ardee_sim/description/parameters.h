// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/element.h"

namespace ardee {

/// Reads the children of one element (a plugin's or sensor's block) as typed values and remembers
/// which keys were asked for, so that finish() can name the keys that were not read. A value that
/// does not parse or lies outside its bounds is an Error with file, line and element; an empty
/// value is its default; an unknown key is a warning, as is a key with one value that comes again.
class Parameters {
 public:
  explicit Parameters(const Element& element) : element_(element) {}

  bool has(const std::string& key);
  std::string text(const std::string& key, const std::string& fallback);
  std::string required_text(const std::string& key);
  /// Finite number within [low, high]; an empty element gives `fallback`, as an absent one does.
  double number(const std::string& key, double fallback,
                double low = -std::numeric_limits<double>::max(),
                double high = std::numeric_limits<double>::max());
  int integer(const std::string& key, int fallback, int low, int high);
  /// true/false/1/0, in any case.
  bool boolean(const std::string& key, bool fallback);
  Eigen::Vector3d vector3(const std::string& key, const Eigen::Vector3d& fallback);
  /// The child element itself, for a nested block; nullptr if absent.
  const Element* block(const std::string& key);
  /// Marks keys as known without reading them (keys that Gazebo's plugins accept and ignore).
  void ignore(const std::set<std::string>& keys);
  /// Warns once for each key that was never asked for or whose value was read from another.
  void finish(Log& log) const;
  const Source& source() const { return element_.source; }
  Error error(const std::string& key, const std::string& what) const;

 private:
  const Element* find(const std::string& key);
  /// Finds the element of a key that has one value.
  const Element* find_value(const std::string& key);
  void note(const AskedKey& key) const;
  /// No value if the text is empty.
  const Element* find_filled(const std::string& key);

  const Element& element_;
  std::set<std::string> known_;
  std::set<std::string> with_one_value_;
};

/// Parses a number: the value of a decimal number, with or without the suffix f of a float, of
/// "inf" or of "nan" in any case; none if the word is anything else.
std::optional<double> to_double(std::string_view word);
/// Parses a finite number with nothing but space around it; throws Error otherwise.
double parse_number(const std::string& text, const Source& source);
bool parse_boolean(const std::string& text, const Source& source);
Eigen::Vector3d parse_vector3(const std::string& text, const Source& source);

}  // namespace ardee
