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

}  // namespace

std::vector<Placement> flatten_scenery(const Instance& instance) {
  std::vector<Placement> placements;
  flatten_into(instance, Pose{}, 1.0, 0, placements);
  return placements;
}

}  // namespace ardee
