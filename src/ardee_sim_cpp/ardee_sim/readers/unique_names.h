// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_map>
#include <unordered_set>

namespace ardee {

/// Makes names unique, as Gazebo does: plant, plant_0, plant_1, ...
class UniqueNames {
 public:
  std::string claim(const std::string& wanted) {
    const std::string name = find_free(wanted);
    take(name);
    return name;
  }
  /// The name that a claim would give.
  std::string find_free(const std::string& wanted) {
    if (taken_.count(wanted) == 0) return wanted;
    int& next = next_[wanted];
    while (true) {
      std::string name = wanted + "_" + std::to_string(next);
      if (taken_.count(name) == 0) return name;
      ++next;
    }
  }
  void take(const std::string& name) { taken_.insert(name); }

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, int> next_;
};

}  // namespace ardee
