// SPDX-License-Identifier: MIT
#include "ardee_sim/core/error.h"

namespace ardee {

std::string Source::to_string() const {
  std::string text = file.empty() ? "<string>" : file;
  if (line > 0) text += ":" + std::to_string(line);
  if (!element.empty()) text += ": <" + element + ">";
  return text;
}

}  // namespace ardee
