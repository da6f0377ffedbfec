// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace ardee::render {

/// Converts a colour to linear sRGB (IEC 61966-2-1); colours outside it end at its border.
inline Eigen::Vector3f linear_srgb(double x, double y, double luminance) {
  const Eigen::Vector3d xyz(luminance * x / y, luminance, luminance * (1.0 - x - y) / y);
  Eigen::Matrix3d from_xyz;
  from_xyz << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  return (from_xyz * xyz).cwiseMax(0.0).cast<float>();
}

}  // namespace ardee::render
