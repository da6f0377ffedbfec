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

/// Whether that name of an element or attribute is another program's: it has a prefix that is not
/// ours ("ignition:config"), or declares one.
bool is_foreign(std::string_view name);

/// A piece of XML kept as plain data: what a sensor's or plugin's own parser reads once its kind is
/// known.
struct Element {
  std::string name;
  std::string text;  // trimmed
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
  Source source;
  std::shared_ptr<KeyLog> key_log =
      nullptr;  // takes down what is asked for, if anybody wants to know

  /// The first child of that name, or nullptr.
  const Element* child(const std::string& child_name) const;
};

}  // namespace ardee
