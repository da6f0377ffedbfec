// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ardee::render {

/// Finds whether some pixels in a row see the same light as their known neighbours, and that light.
/// Each number is an array, because several pixels are processed at once.
struct NeighbourInterpolation {
  static constexpr int kMost = 16;
  /// Data of all pixels of a tile, by their places.
  struct Lists {
    const float* normal_x_W;
    const float* normal_y_W;
    const float* normal_z_W;
    const float* range_m;
    const float* red;
    const float* green;
    const float* blue;
    const std::uint32_t* surface;
    const std::uint32_t* triangle;
    const std::uint32_t* known;  // known lamps, a bit each
    const std::uint32_t* in_shadow;
  };
  /// Places of the first pixel's neighbours; the neighbours of the other pixels follow.
  using Neighbours = std::array<std::size_t, 4>;

  /// Interpolates kMost pixels side by side. Neighbours on the same smooth surface count, and are
  /// even if no colour differs by more than `most`.
  void find(const Lists& lists, std::size_t first, const Neighbours& around, float most);

  float red[kMost], green[kMost], blue[kMost];  // mean
  std::uint32_t known[kMost], in_shadow[kMost];
  std::uint32_t even[kMost];  // 0: not even
};

}  // namespace ardee::render
