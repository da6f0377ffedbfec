// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/time.h"

namespace ardee::devices {

/// When and in which frame something was measured.
struct Header {
  TimeNs stamp_ns = 0;
  std::string frame_id;
};

}  // namespace ardee::devices
