// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

namespace ardee {

/// Red, green, blue, opacity in [0, 1].
using Color = Eigen::Vector4f;

/// Appearance of a surface, already resolved from SDF, OGRE script, URDF colour or mesh file.
struct Material {
  std::string name;
  Color ambient{0.7f, 0.7f, 0.7f, 1.0f};
  Color diffuse{0.7f, 0.7f, 0.7f, 1.0f};
  Color specular{0.0f, 0.0f, 0.0f, 1.0f};
  Color emissive{0.0f, 0.0f, 0.0f, 1.0f};
  std::string texture_path;  // image file; empty: none
  /// OGRE's cull_hardware none: seen from behind as well (thesis Listing A.14).
  bool two_sided = false;
  float alpha_rejection = -1.0f;  // texels whose opacity is not above this are holes; < 0: none
};

}  // namespace ardee
