// SPDX-License-Identifier: MIT
// Names in requests: models, links, joints, reference frames.
#include "ros/services.h"

namespace ardee::node {

Entity& require_model(Stage& stage, const std::string& name) {
  Entity* entity = stage.simulation.find(name);
  if (!entity) throw Error("model '" + name + "' does not exist");
  return *entity;
}

LinkRef require_link(Stage& stage, const std::string& scoped_name) {
  const std::size_t colons = scoped_name.find("::");
  if (colons == std::string::npos) {
    throw Error("found link '" + scoped_name + "', expected model::link");
  }
  Entity* entity = stage.simulation.find(scoped_name.substr(0, colons));
  if (!entity) throw Error("link '" + scoped_name + "' does not exist: no such model");
  const std::string link_name = scoped_name.substr(colons + 2);
  const auto& links = entity->robot->model().links;
  for (std::size_t link = 0; link < links.size(); ++link) {
    if (links[link].name == link_name) return {*entity, link};
  }
  throw Error("link '" + scoped_name + "' does not exist: the model has no such link");
}

JointRef require_joint(Stage& stage, const std::string& name) {
  const std::size_t colons = name.find("::");
  const std::string joint_name = colons == std::string::npos ? name : name.substr(colons + 2);
  for (const auto& entity : stage.simulation.entities()) {
    if (colons != std::string::npos && entity->name() != name.substr(0, colons)) continue;
    if (!entity->robot->is_dynamic()) continue;
    const auto& joints = entity->robot->model().joints;
    for (std::size_t joint = 0; joint < joints.size(); ++joint) {
      if (joints[joint].name == joint_name) return {*entity, joint};
    }
  }
  throw Error("joint '" + name + "' does not exist");
}

RelativeState frame_in_world(Stage& stage, const std::string& reference, const std::string& field) {
  try {
    return stage.simulation.state(reference, "");
  } catch (const Error&) {
    throw Error("reference " + field +
                " not found, did you forget to scope the link by model name?" + " (" + field +
                " '" + reference + "')");
  }
}

}  // namespace ardee::node
