// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/devices/registry.h"

namespace ardee {

/// All plugins that a simulation knows: the devices, and ros_control.
devices::Registry known_plugins();

}  // namespace ardee
