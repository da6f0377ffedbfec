// SPDX-License-Identifier: MIT
#include "ardee_sim/core/error.h"

namespace ardee {

std::string Source::to_string() const {
  std::string text = file.empty() ? "<string>" : file;
  if (line > 0) text += ":" + std::to_string(line);
  if (!element.empty()) text += ": <" + element + ">";
  return text;
}

std::string in_quotes(const std::string& text) {
  constexpr std::size_t kLongest = 80;
  return "'" + (text.size() > kLongest ? text.substr(0, kLongest) + "..." : text) + "'";
}

}  // namespace ardee
