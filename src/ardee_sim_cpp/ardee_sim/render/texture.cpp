// SPDX-License-Identifier: MIT
#include "ardee_sim/render/texture.h"

#include <algorithm>
#include <cmath>

namespace ardee {

Texture::Texture(const Image& image) {
  Level whole;
  whole.width = image.width;
  whole.height = image.height;
  whole.texels.reserve(static_cast<std::size_t>(image.width) *
                       static_cast<std::size_t>(image.height));
  for (std::size_t i = 0; i + 3 < image.samples8.size(); i += 4) {
    whole.texels.emplace_back(image.samples8[i], image.samples8[i + 1], image.samples8[i + 2],
                              image.samples8[i + 3]);
    whole.texels.back() /= 255.0f;
  }
  levels_.push_back(std::move(whole));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    levels_.push_back(halved(levels_.back()));
  }
}

const Eigen::Vector4f& Texture::Level::at(int column, int row) const {
  return texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(column)];
}

/// Each texel is the mean of four, weighted by their opacity: what is under a hole has no say.
Texture::Level Texture::halved(const Level& level) {
  Level half;
  half.width = std::max(1, level.width / 2);
  half.height = std::max(1, level.height / 2);
  for (int row = 0; row < half.height; ++row) {
    for (int column = 0; column < half.width; ++column) {
      Eigen::Vector4f mean = Eigen::Vector4f::Zero();
      float opacity = 0.0f;
      for (int k = 0; k < 4; ++k) {
        const Eigen::Vector4f& texel = level.at(std::min(2 * column + (k & 1), level.width - 1),
                                                std::min(2 * row + (k >> 1), level.height - 1));
        mean += texel[3] * texel;
        opacity += texel[3];
      }
      if (opacity > 0.0f) mean /= opacity;
      mean[3] = 0.25f * opacity;
      half.texels.push_back(mean);
    }
  }
  return half;
}

Color Texture::Level::bilinear(const Eigen::Vector2d& uv) const {
  const double x = (uv.x() - std::floor(uv.x())) * width - 0.5;
  const double y = (1.0 - (uv.y() - std::floor(uv.y()))) * height - 0.5;
  const double left = std::floor(x);
  const double upper = std::floor(y);
  // Within one of the range [0, count): no division.
  const auto wrap = [](int k, int count) { return k < 0 ? k + count : k >= count ? k - count : k; };
  const int c0 = wrap(static_cast<int>(left), width), c1 = wrap(static_cast<int>(left) + 1, width);
  const int r0 = wrap(static_cast<int>(upper), height);
  const int r1 = wrap(static_cast<int>(upper) + 1, height);
  const auto a = static_cast<float>(x - left);
  const auto b = static_cast<float>(y - upper);
  return (1.0f - b) * ((1.0f - a) * at(c0, r0) + a * at(c1, r0)) +
         b * ((1.0f - a) * at(c0, r1) + a * at(c1, r1));
}

Color Texture::color(const Eigen::Vector2d& uv, double footprint) const {
  if (!uv.allFinite()) return levels_.back().texels.front();
  const int side = std::max(levels_.front().width, levels_.front().height);
  const double wanted = std::log2(std::max(footprint * side, 1.0));
  const double last = static_cast<double>(levels_.size() - 1);
  const double level = std::min(wanted, last);
  const auto fine = static_cast<std::size_t>(level);
  const auto share = static_cast<float>(level - static_cast<double>(fine));
  const Color near = levels_[fine].bilinear(uv);
  if (share == 0.0f) return near;
  return (1.0f - share) * near + share * levels_[fine + 1].bilinear(uv);
}

}  // namespace ardee
