// SPDX-License-Identifier: MIT
#include "ardee_sim/description/model.h"

#include <algorithm>

namespace ardee {
namespace {

template <typename Item>
const Item* find_named(const std::vector<Item>& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&name](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

const Link* Model::find_link(const std::string& link_name) const {
  return find_named(links, link_name);
}

const Joint* Model::find_joint(const std::string& joint_name) const {
  return find_named(joints, joint_name);
}

}  // namespace ardee
