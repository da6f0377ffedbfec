// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/controller_types.h"

namespace ardee::control {

const ControllerTypes& controller_types() {
  static const ControllerTypes types{};
  return types;
}

}  // namespace ardee::control
