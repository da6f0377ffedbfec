// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "ardee_sim/controllers/controller.h"

namespace ardee::control {

/// Makes a controller or throws Error.
using ControllerMaker = std::function<std::unique_ptr<Controller>(const ControllerContext&)>;
using ControllerTypes = std::map<std::string, ControllerMaker>;

/// All built-in controllers, one line each, by the type names of ros_controllers.
const ControllerTypes& controller_types();

}  // namespace ardee::control
