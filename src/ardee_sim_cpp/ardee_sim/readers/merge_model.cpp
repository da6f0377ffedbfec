// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/sdf_reader.h"

namespace ardee {
namespace {

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
  for (Link link : nested.links) {
    link.name = prefix + link.name;
    link.X_ML = X_MN * link.X_ML;
    for (SensorDescription& sensor : link.sensors) {
      for (PluginDescription& plugin : sensor.plugins) plugin.scope = prefix + plugin.scope;
    }
    made.links.push_back(std::move(link));
  }
  for (Joint joint : nested.joints) {
    joint.name = prefix + joint.name;
    joint.parent = scoped(joint.parent);
    joint.child = scoped(joint.child);
    made.joints.push_back(std::move(joint));
  }
  for (Transmission transmission : nested.transmissions) {
    transmission.joint = prefix + transmission.joint;
    made.transmissions.push_back(std::move(transmission));
  }
  for (Coupling coupling : nested.couplings) {
    coupling.leader = prefix + coupling.leader;
    coupling.follower = prefix + coupling.follower;
    made.couplings.push_back(coupling);
  }
  made.allow_auto_disable = made.allow_auto_disable && nested.allow_auto_disable;
  for (NamedFrame frame : nested.frames) {
    frame.link = scoped(frame.link.empty() ? nested.canonical_link : frame.link);
    made.frames.push_back({prefix + frame.name, X_MN * frame.X_MF, frame.link, frame.is_model});
  }
  // The model itself is a frame, to which other elements may refer.
  if (!name.empty()) made.frames.push_back({name, X_MN, prefix + nested.canonical_link, true});
  for (PluginDescription plugin : nested.plugins) {
    plugin.scope = prefix + plugin.scope;
    made.plugins.push_back(std::move(plugin));
  }
  for (Instance instance : nested.instances) {
    instance.name = prefix + instance.name;
    instance.pose = X_MN * instance.pose;
    made.instances.push_back(std::move(instance));
  }
}

}  // namespace ardee
