// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ardee_sim/devices/reading_header.h"

namespace ardee::devices {

/// A picture; `encoding` is one of sensor_msgs/image_encodings, rows are `step` bytes,
/// little-endian.
struct ImageReading {
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding;
  std::uint32_t step = 0;
  std::vector<std::uint8_t> data;
};

/// A camera's calibration (sensor_msgs/CameraInfo), plumb_bob: D = k1, k2, t1, t2, k3.
struct CameraInfoReading {
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::array<double, 5> D{};
  std::array<double, 9> K{};
  std::array<double, 9> R{1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::array<double, 12> P{};
};

}  // namespace ardee::devices
