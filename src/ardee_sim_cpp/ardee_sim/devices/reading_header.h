// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/time.h"

namespace ardee::devices {

/// Time and frame of a measurement.
struct Header {
  TimeNs stamp_ns = 0;
  std::string frame_id;
};

}  // namespace ardee::devices
