// SPDX-License-Identifier: MIT
#include "ardee_sim/description/scenery.h"

namespace ardee {
namespace {

void flatten_into(const Instance& instance, const Pose& X_WP, double parent_scale,
                  std::uint32_t parent_label, std::vector<Placement>& placements) {
  const Pose X_PM{parent_scale * instance.pose.p, instance.pose.q};
  const Pose X_WM = X_WP * X_PM;
  const double scale = parent_scale * instance.scale;
  const std::uint32_t label = instance.label != 0 ? instance.label : parent_label;
  if (!instance.model->links.empty()) placements.push_back({instance.model, X_WM, scale, label});
  for (const Instance& child : instance.model->instances) {
    flatten_into(child, X_WM, scale, label, placements);
  }
}

/// Counts `left` down to the placement; returns its name, or an empty one if it is not in this
/// model.
std::string name_within(const Instance& instance, const std::string& name, std::size_t& left) {
  if (!instance.model->links.empty() && left-- == 0) return name;
  for (const Instance& child : instance.model->instances) {
    const std::string found = name_within(child, name + "::" + child.name, left);
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace

std::vector<Placement> flatten_scenery(const Instance& instance) {
  std::vector<Placement> placements;
  flatten_into(instance, Pose{}, 1.0, 0, placements);
  return placements;
}

PlacementNames placement_names(const Instance& instance) {
  return
      [instance](std::size_t placement) { return name_within(instance, instance.name, placement); };
}

}  // namespace ardee
