// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ardee_sim/description/material.h"
#include "ardee_sim/readers/image.h"

namespace ardee {

/// A picture that repeats, with ever smaller copies of itself for places seen from far.
class Texture {
 public:
  /// `image` has four channels of 8 bits.
  explicit Texture(const Image& image);

  /// The colour about (u, v), v upwards from the lower edge, averaged over a square of `footprint`
  /// a side (in units of u).
  Color color(const Eigen::Vector2d& uv, double footprint) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<Eigen::Vector4f> texels;  // row 0 is the upper edge

    const Eigen::Vector4f& at(int column, int row) const;
    Color bilinear(const Eigen::Vector2d& uv) const;
  };

  static Level halved(const Level& level);

  std::vector<Level> levels_;
};

}  // namespace ardee
