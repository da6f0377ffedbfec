// SPDX-License-Identifier: MIT
#include "ardee_sim/description/element.h"

namespace ardee {

bool is_foreign(std::string_view name) {
  const std::size_t colon = name.find(':');
  return name == "xmlns" || (colon != std::string_view::npos && name.substr(0, colon) != "ardee");
}

const Element* Element::child(const std::string& child_name) const {
  for (const Element& candidate : children) {
    if (candidate.name == child_name) return &candidate;
  }
  return nullptr;
}

}  // namespace ardee
