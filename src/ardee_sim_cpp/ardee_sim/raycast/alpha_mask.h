// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/log.h"

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
  explicit AlphaMasks(Log log) : log_(std::move(log)) {}

  /// Returns nullptr for a texture without holes; also, with a warning, for one that cannot be
  /// read.
  std::shared_ptr<const AlphaMask> get(const std::string& path, float rejection);

 private:
  Log log_;
  std::map<std::pair<std::string, float>, std::weak_ptr<const AlphaMask>> masks_;
  std::set<std::pair<std::string, float>> without_holes_;
};

}  // namespace ardee::raycast
