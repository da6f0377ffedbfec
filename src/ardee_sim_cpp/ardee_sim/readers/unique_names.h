// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>

namespace ardee {

/// Gives each thing a name of its own, as Gazebo does: plant, plant_0, plant_1, ...
class UniqueNames {
 public:
  std::string claim(const std::string& wanted) {
    if (taken_.insert(wanted).second) return wanted;
    int& next = next_[wanted];
    while (true) {
      std::string name = wanted + "_" + std::to_string(next++);
      if (taken_.insert(name).second) return name;
    }
  }
  bool is_taken(const std::string& name) const { return taken_.count(name) != 0; }

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> next_;
};

}  // namespace ardee
