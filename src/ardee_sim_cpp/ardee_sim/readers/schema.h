// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <unordered_map>

#include "ardee_sim/core/log.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Which elements may stand in which, to find misspelt ones.
class Schema {
 public:
  /// Lines of "parent: child child ...". A name without a line of its own is not looked into.
  explicit Schema(const char* lines);

  /// Warns of each element below `node` that is not known at its place; `format` is the file
  /// format's name. Elements of a foreign XML namespace are left to their owners.
  void warn_of_unknown(const Node& node, const char* format, Log& log) const;

 private:
  std::unordered_map<std::string, std::set<std::string, std::less<>>> children_;
};

/// SDF 1.2 to 1.7 and ARDEE's own elements. Sensors and plugins are left to their own parsers.
const Schema& sdf_schema();
/// URDF without <gazebo> blocks.
const Schema& urdf_schema();

}  // namespace ardee
