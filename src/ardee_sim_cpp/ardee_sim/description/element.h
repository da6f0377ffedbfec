// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/key_log.h"

namespace ardee {

/// Whether the name of an element or attribute belongs to another program: it has a prefix that is
/// not ours ("ignition:config"), or declares one.
bool is_foreign(std::string_view name);

/// XML element kept as plain data, which a sensor's or plugin's own parser reads once its kind is
/// known.
struct Element {
  std::string name;
  std::string text;  // trimmed
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
  Source source;
  std::shared_ptr<KeyLog> key_log = nullptr;  // records the keys that are read; may be null

  /// The first child of that name, or nullptr.
  const Element* child(const std::string& child_name) const;
};

}  // namespace ardee
