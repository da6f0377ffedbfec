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

/// Which texels of a texture are holes.
class AlphaMask {
 public:
  /// Texels whose opacity is not above `rejection` are holes. Throws Error if the image cannot be
  /// read.
  AlphaMask(const std::string& path, float rejection);

  /// The texel under (u, v), v upwards from the lower edge; the texture repeats.
  bool is_hole(const Eigen::Vector2d& uv) const;
  bool has_holes() const;

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<bool> holes_;  // row 0 is the upper edge
};

/// The masks in use, each texture read once.
class AlphaMasks {
 public:
  explicit AlphaMasks(Log log) : log_(std::move(log)) {}

  /// Nullptr if the texture has no holes; one that cannot be read has none, with a warning.
  std::shared_ptr<const AlphaMask> get(const std::string& path, float rejection);

 private:
  Log log_;
  std::map<std::pair<std::string, float>, std::weak_ptr<const AlphaMask>> masks_;
  std::set<std::pair<std::string, float>> without_holes_;
};

}  // namespace ardee::raycast
