// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/core/error.h"

namespace ardee::raycast {

/// Holes of a texture: one flag a texel.
class AlphaMask {
 public:
  /// Marks texels whose opacity is not above `rejection` as holes. Throws Error if the image cannot
  /// be read.
  AlphaMask(const std::string& path, float rejection);

  /// Returns whether the texel under (u, v) is a hole, v upwards from the lower edge; the texture
  /// repeats.
  bool is_hole(const Eigen::Vector2d& uv) const;
  bool has_holes() const;

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<bool> holes_;  // row 0 is the upper edge
};

/// Masks in use; each texture is read once.
class AlphaMasks {
 public:
  /// Returns the mask of a texture, perhaps without a hole. Throws Error if it cannot be read.
  std::shared_ptr<const AlphaMask> get(const std::string& path, float rejection);

 private:
  std::map<std::pair<std::string, float>, std::weak_ptr<const AlphaMask>> masks_;
};

}  // namespace ardee::raycast
