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

std::size_t bytes_of(const Element& element) {
  std::size_t bytes = sizeof(Element) + element.text.size();
  for (const auto& [name, value] : element.attributes) bytes += sizeof(name) + value.size();
  for (const Element& child : element.children) bytes += bytes_of(child);
  return bytes;
}

}  // namespace

std::size_t bytes_of(const Model& model) {
  std::size_t bytes = model.joints.size() * sizeof(Joint) +
                      model.instances.size() * sizeof(Instance) +
                      model.frames.size() * sizeof(NamedFrame);
  for (const Link& link : model.links) {
    bytes += sizeof(Link) + link.collisions.size() * sizeof(Collision) +
             link.visuals.size() * sizeof(Visual);
    for (const SensorDescription& sensor : link.sensors) bytes += bytes_of(sensor.element);
  }
  for (const PluginDescription& plugin : model.plugins) bytes += bytes_of(plugin.element);
  return bytes;
}

void merge_model(const Model& nested, const Pose& X_MN, const std::string& name, Model& made) {
  const std::string prefix = name.empty() ? "" : name + "::";
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
  for (NamedFrame frame : nested.frames) {
    frame.link = scoped(frame.link.empty() ? nested.canonical_link : frame.link);
    made.frames.push_back({prefix + frame.name, X_MN * frame.X_MF, frame.link});
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
