// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace ardee::render {

/// A part of a picture, in pixels.
struct TileArea {
  int left = 0;
  int upper = 0;
  int width = 0;
  int height = 0;
};

/// What to find out about each pixel; nothing else is worked out.
struct FrameParts {
  bool light = false;
  bool depth = false;
  bool ids = false;

  bool any() const { return light || depth || ids; }
};

/// What a camera's sensor would see, pixel by pixel, row 0 uppermost: before exposure, noise and
/// format. The parts that were not wanted are empty.
struct Frame {
  int width = 0;
  int height = 0;
  int threads = 0;                      // for what becomes of it; 0: all cores
  std::vector<Eigen::Vector3f> light;   // red, green, blue; 1: a white surface in full light
  std::vector<float> depth_m;           // along the camera's axis; +inf: nothing
  std::vector<std::uint32_t> entities;  // kNoEntity: nothing
  std::vector<std::uint16_t> labels;    // 0: none

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

}  // namespace ardee::render
