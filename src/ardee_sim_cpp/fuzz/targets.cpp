// SPDX-License-Identifier: MIT
#include "fuzz/targets.h"

#include <algorithm>

#include "ardee_sim/core/error.h"

namespace ardee::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"world", read_world},  {"model", read_model},
      {"urdf", read_model},   {"mesh", read_mesh},
      {"image", read_image},  {"material", read_material},
      {"gps", read_gps},      {"instances", read_instances},
      {"simulate", simulate}, {"controller", control_robot},
  };
  return all;
}

const Target* find_target(const std::string& name) {
  const auto found = std::find_if(targets().begin(), targets().end(),
                                  [&name](const Target& target) { return target.name == name; });
  return found == targets().end() ? nullptr : &*found;
}

bool accepts(const Target& target, const std::string& input) {
  try {
    target.run(input);
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace ardee::fuzz
