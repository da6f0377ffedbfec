// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/plugins.h"

#include "ardee_sim/controllers/ros_control.h"

namespace ardee {

devices::Registry known_plugins() {
  devices::Registry registry = devices::builtin_registry();
  control::add_ros_control(registry);
  return registry;
}

}  // namespace ardee
