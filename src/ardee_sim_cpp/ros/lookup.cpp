// SPDX-License-Identifier: MIT Contents of requests: numbers; names of models, links, joints,
// reference frames.
#include <optional>
#include <sstream>

#include "ardee_sim/core/nearest_names.h"
#include "ros/services.h"

namespace ardee::node {

double checked(const std::string& field, double value, double low, double high) {
  if (value >= low && value <= high) return value;
  std::ostringstream text;
  text << field << ": found " << value << ", expected " << low << " to " << high;
  throw Error(text.str());
}

Entity& require_model(ServiceContext& context, const std::string& name) {
  Entity* entity = context.simulation.find(name);
  if (!entity) {
    std::vector<std::string> known;
    for (const auto& each : context.simulation.entities()) known.push_back(each->name());
    throw Error("model '" + name + "' does not exist, nearest: " + nearest_names(name, known));
  }
  return *entity;
}

LinkRef require_link(ServiceContext& context, const std::string& name) {
  if (const auto found = context.simulation.find_link(name)) return {*found->entity, found->link};
  throw Error("link '" + name + "' does not exist, expected model::link");
}

JointRef require_joint(ServiceContext& context, const std::string& name) {
  std::optional<JointRef> unscoped;
  for (const auto& entity : context.simulation.entities()) {
    if (!entity->robot->is_dynamic()) continue;
    const auto& joints = entity->robot->model().joints;
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
      if (entity->name() + "::" + joints[joint].name == name) return {*entity, joint};
      if (!unscoped && joints[joint].name == name) unscoped.emplace(JointRef{*entity, joint});
    }
  }
  if (!unscoped) throw Error("joint '" + name + "' does not exist");
  return *unscoped;
}

RelativeState frame_in_world(ServiceContext& context, const std::string& reference,
                             const std::string& field) {
  try {
    return context.simulation.state(reference, "");
  } catch (const Error&) {
    throw Error("reference " + field +
                " not found, did you forget to scope the link by model name?" + " (" + field +
                " '" + reference + "')");
  }
}

}  // namespace ardee::node
