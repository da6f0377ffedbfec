// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ardee_sim/description/material.h"
#include "ardee_sim/image/image.h"

namespace ardee::render {

/// Repeating picture with successively halved copies for distant surfaces.
class Texture {
 public:
  /// Takes an image with four channels of 8 bits.
  explicit Texture(const Image& image);

  /// Returns the colour about (u, v), v upwards from the lower edge, averaged over a square with
  /// sides of `footprint` (in units of u).
  Color color(const Eigen::Vector2d& uv, double footprint) const;

 private:
  using Texel = std::array<std::uint8_t, 4>;  // red, green, blue, opacity

  struct Level {
    int width = 0;
    int height = 0;
    std::vector<Texel> texels;  // row 0 is the upper edge

    const Texel& at(int column, int row) const {
      return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(column)];
    }
    Color bilinear(const Eigen::Vector2d& uv) const;
  };

  static Level halved(const Level& level);

  std::vector<Level> levels_;
};

}  // namespace ardee::render
