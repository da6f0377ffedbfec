// SPDX-License-Identifier: MIT
#include "ardee_sim/description/element.h"

namespace ardee {

const Element* Element::child(const std::string& child_name) const {
  for (const Element& candidate : children) {
    if (candidate.name == child_name) return &candidate;
  }
  return nullptr;
}

}  // namespace ardee
