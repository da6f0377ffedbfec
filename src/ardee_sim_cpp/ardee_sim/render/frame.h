// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace ardee::render {

/// Part of a picture, in pixels.
struct TileArea {
  int left = 0;
  int upper = 0;
  int width = 0;
  int height = 0;
};

/// Kinds of data to compute for each pixel.
struct FrameParts {
  bool light = false;
  bool depth = false;
  bool ids = false;
  bool visuals = false;

  bool any() const { return light || depth || ids || visuals; }
};

/// Number of a visual, among all of its model, in Frame::visuals.
constexpr std::uint32_t visual_number(std::uint32_t link, std::uint32_t shape) {
  return (link << 16 | shape) + 1;
}

/// Picture as it falls onto a camera's sensor, pixel by pixel, row 0 uppermost: before exposure,
/// noise and format. Parts that were not requested are empty.
struct Frame {
  int width = 0;
  int height = 0;
  int threads = 0;                      // for form_image(); 0: all cores
  std::vector<Eigen::Vector3f> light;   // red, green, blue; 1: a white surface in full light
  std::vector<float> depth_m;           // along the camera's axis; +inf: no hit
  std::vector<std::uint32_t> entities;  // kNoEntity: no hit
  std::vector<std::uint16_t> labels;    // 0: none
  std::vector<std::uint32_t> visuals;   // visual_number(); 0: no hit

  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

}  // namespace ardee::render
