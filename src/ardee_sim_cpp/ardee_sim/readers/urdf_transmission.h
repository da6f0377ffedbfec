// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Reads a <transmission> as ros_control's parser and DefaultRobotHWSim do
/// (http://wiki.ros.org/urdf/XML/Transmission). An incomplete transmission is left out with an
/// error in the log, one of several joints with a warning.
std::optional<Transmission> read_transmission(const Node& transmission, Log& log);

}  // namespace ardee
