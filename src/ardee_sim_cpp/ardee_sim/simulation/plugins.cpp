// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/plugins.h"

#include "ardee_sim/controllers/ros_control.h"

namespace ardee {

Registry known_plugins() {
  Registry registry = builtin_registry();
  control::add_ros_control(registry);
  return registry;
}

}  // namespace ardee
