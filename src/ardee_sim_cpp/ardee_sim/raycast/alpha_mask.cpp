// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/alpha_mask.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/image/image.h"

namespace ardee::raycast {
namespace {

constexpr std::size_t kOpacityChannel = 3;

/// Index of the texel at a coordinate that repeats with period 1.
int texel(double coordinate, int count) {
  const double share = coordinate - std::floor(coordinate);
  return std::min(static_cast<int>(share * count), count - 1);
}

}  // namespace

AlphaMask::AlphaMask(const std::string& path, float rejection) {
  const Image image = read_color_image(path, {path, 0, ""});
  width_ = image.width;
  height_ = image.height;
  holes_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int row = 0; row < height_; ++row) {
    for (int column = 0; column < width_; ++column) {
      const auto opacity = image.samples8[image.index(column, row) + kOpacityChannel];
      holes_.push_back(static_cast<float>(opacity) <= 255.0f * rejection);
    }
  }
}

bool AlphaMask::is_hole(const Eigen::Vector2d& uv) const {
  if (!uv.allFinite()) return false;
  const int column = texel(uv.x(), width_);
  const int row = height_ - 1 - texel(uv.y(), height_);
  return holes_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(column)];
}

bool AlphaMask::has_holes() const {
  return std::find(holes_.begin(), holes_.end(), true) != holes_.end();
}

std::shared_ptr<const AlphaMask> AlphaMasks::get(const std::string& path, float rejection) {
  std::weak_ptr<const AlphaMask>& entry = masks_[{path, rejection}];
  std::shared_ptr<const AlphaMask> mask = entry.lock();
  if (mask == nullptr) entry = mask = std::make_shared<const AlphaMask>(path, rejection);
  return mask;
}

}  // namespace ardee::raycast
