// SPDX-License-Identifier: MIT
#include <set>

#include "ardee_sim/readers/sdf_reader.h"

namespace ardee {
namespace {

/// A plugin's texts that name a link or joint of the nested model get that one's new name.
void scope_texts(const std::set<std::string>& names, const std::string& prefix, Element& element) {
  if (names.count(element.text) != 0) element.text = prefix + element.text;
  for (Element& child : element.children) scope_texts(names, prefix, child);
}

}  // namespace

void merge_model(const Model& nested, const Pose& X_MN, const std::string& name, Model& made) {
  const std::string prefix = name + "::";
  const auto scoped = [&prefix](const std::string& link) {
    return link == "world" ? link : prefix + link;
  };
  std::set<std::string> names;
  for (Link link : nested.links) {
    names.insert(link.name);
    link.name = prefix + link.name;
    link.X_ML = X_MN * link.X_ML;
    made.links.push_back(std::move(link));
  }
  for (Joint joint : nested.joints) {
    names.insert(joint.name);
    joint.name = prefix + joint.name;
    joint.parent = scoped(joint.parent);
    joint.child = scoped(joint.child);
    made.joints.push_back(std::move(joint));
  }
  for (PluginDescription plugin : nested.plugins) {
    scope_texts(names, prefix, plugin.element);
    made.plugins.push_back(std::move(plugin));
  }
  for (Instance instance : nested.instances) {
    instance.name = prefix + instance.name;
    instance.pose = X_MN * instance.pose;
    made.instances.push_back(std::move(instance));
  }
}

}  // namespace ardee
