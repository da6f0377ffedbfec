// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace ardee {

/// Place in a user's input: file, line (0 if the parser knows none) and element path.
struct Source {
  std::string file;
  int line = 0;
  std::string element;

  /// "file:line: <element>", as far as known.
  std::string to_string() const;
};

/// Quotes the text that was found, for a message, cut to 80 characters.
std::string in_quotes(const std::string& text);

/// One-line description of an invalid input: place, found text, expected text.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& what) : std::runtime_error(what) {}
  Error(const Source& source, const std::string& what)
      : std::runtime_error(source.to_string() + ": " + what) {}
};

}  // namespace ardee
