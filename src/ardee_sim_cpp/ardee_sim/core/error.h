// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace ardee {

/// Where in a user's input something stands: file, line (0 where the parser knows none) and element
/// path.
struct Source {
  std::string file;
  int line = 0;
  std::string element;

  /// "file:line: <element>", as far as known.
  std::string to_string() const;
};

/// What was found, for a message: in quotes, and no more than 80 characters of it.
std::string in_quotes(const std::string& text);

/// What is wrong with an input, in one line: place, what was found, what was expected.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& what) : std::runtime_error(what) {}
  Error(const Source& source, const std::string& what)
      : std::runtime_error(source.to_string() + ": " + what) {}
};

}  // namespace ardee
