// SPDX-License-Identifier: MIT
#include "ardee_sim/render/tile.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "ardee_sim/render/tone.h"

namespace ardee::render {
namespace {

/// Returns the bits of a number mirrored behind the binary point; with k / n they give an even
/// pattern (Hammersley).
double mirrored_bits(unsigned number) {
  double result = 0.0;
  for (double bit = 0.5; number != 0; number >>= 1, bit *= 0.5) {
    if ((number & 1u) != 0) result += bit;
  }
  return result;
}

class Tile {
 public:
  Tile(const TileShading& shading, const TileArea& area, TileWorker& worker)
      : s_(shading), area_(area), shader_(worker.shader), adaptive_(worker.adaptive) {
    shader_.begin(shading);
  }

  /// Shades `samples` rays a pixel, in a fixed pattern.
  void shade(Image& image) {
    const int count = s_.options.samples;
    for (int k = 0; k < area_.width * area_.height; ++k) {
      const double x = area_.left + k % area_.width;
      const double y = area_.upper + k / area_.width;
      for (int i = 0; i < count; ++i) {
        const double dx = (i + 0.5) / count;
        const double dy = mirrored_bits(static_cast<unsigned>(i)) + 0.5 / count;
        shader_.enqueue(x + dx, y + std::fmod(dy, 1.0));
      }
    }
    shader_.flush();
    write(image);
  }

  /// Renders one ray through the middle of each pixel.
  void render_frame(const FrameParts& parts, Frame& frame) {
    const bool approximate = parts.light && s_.options.approximate;
    if (parts.depth || parts.ids || !approximate) enqueue_all(frame);
    if (parts.depth || parts.ids) write_hits(parts, frame);
    if (approximate) {
      shader_.clear();
      adaptive_.shade(s_, area_, shader_, frame);
    }
    if (approximate || !parts.light) return;
    shader_.flush();
    for (std::size_t k = 0; k < shader_.samples().size(); ++k) {
      frame.light[pixels_[k]] = shader_.samples()[k].light;
    }
  }

 private:
  /// Begins with a ray through each pixel that is wanted.
  void enqueue_all(const Frame& frame) {
    const int end = area_.left + area_.width;
    for (int row = area_.upper; row < area_.upper + area_.height; ++row) {
      const std::size_t before = frame.index(0, row);
      for (int column = next_wanted(before, area_.left); column < end;
           column = next_wanted(before, column + 1)) {
        pixels_.push_back(before + static_cast<std::size_t>(column));
        shader_.enqueue(column + 0.5, row + 0.5);
      }
    }
  }

  /// Returns the first column from `column` on that is wanted, or the tile's end; `before` pixels
  /// lie before the row.
  int next_wanted(std::size_t before, int column) const {
    const int end = area_.left + area_.width;
    if (s_.options.wanted == nullptr || column >= end) return column;
    const std::uint8_t* row = s_.options.wanted->data() + before;
    const void* found = std::memchr(row + column, 1, static_cast<std::size_t>(end - column));
    return found ? static_cast<int>(static_cast<const std::uint8_t*>(found) - row) : end;
  }

  void write(Image& image) const {
    const auto count = static_cast<std::size_t>(s_.options.samples);
    for (int k = 0; k < area_.width * area_.height; ++k) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t i = 0; i < count; ++i) {
        const Sample& sample = shader_.samples()[static_cast<std::size_t>(k) * count + i];
        sum += sample.light.unaryExpr(&tone);
      }
      const std::size_t at =
          image.index(area_.left + k % area_.width, area_.upper + k / area_.width);
      for (int c = 0; c < 3; ++c) {
        image.samples8[at + static_cast<std::size_t>(c)] =
            to_byte(sum[c] / static_cast<float>(count));
      }
      image.samples8[at + 3] = 255;
    }
  }

  void write_hits(const FrameParts& parts, Frame& frame) const {
    const std::vector<raycast::SceneRay>& rays = shader_.rays();
    std::vector<raycast::RayHit> hits(rays.size());
    s_.rays.intersect(rays.data(), rays.size(), hits.data());
    const std::vector<Sample>& samples = shader_.samples();
    std::vector<raycast::RayHit> of_pixel(samples.size());
    for (std::size_t i = 0; i < rays.size(); ++i) of_pixel[shader_.owners()[i]] = hits[i];
    for (std::size_t k = 0; k < of_pixel.size(); ++k) {
      const raycast::RayHit& hit = of_pixel[k];
      const bool met = hit.entity != raycast::kNoEntity;
      const std::size_t at = pixels_[k];
      if (parts.depth) {
        const double range_m = samples[k].travelled_m + static_cast<double>(hit.range_m);
        frame.depth_m[at] = met ? static_cast<float>(range_m / samples[k].stretch)
                                : std::numeric_limits<float>::infinity();
      }
      if (parts.ids) {
        frame.entities[at] = hit.entity;
        frame.labels[at] = static_cast<std::uint16_t>(hit.label);
      }
      if (parts.visuals) frame.visuals[at] = met ? visual_number(hit.link, hit.shape) : 0;
    }
  }

  const TileShading& s_;
  const TileArea area_;
  Shader& shader_;
  AdaptiveTile& adaptive_;
  std::vector<std::size_t> pixels_;  // of render_frame(): the place of each sample in the frame
};

}  // namespace

void shade_tile(const TileShading& shading, const TileArea& area, TileWorker& worker,
                Image& image) {
  Tile(shading, area, worker).shade(image);
}

void render_frame_tile(const TileShading& shading, const TileArea& area, const FrameParts& parts,
                       TileWorker& worker, Frame& frame) {
  Tile(shading, area, worker).render_frame(parts, frame);
}

}  // namespace ardee::render
