// SPDX-License-Identifier: MIT
#include "ardee_sim/render/tile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ardee_sim/render/tone.h"

namespace ardee {
namespace {

/// What lies between looks at one smooth surface is theirs too if they differ by less in light, and
/// in depth (as a share of it) from a plane.
constexpr float kSameLight = 0.1f;
constexpr float kSameRange = 0.02f;

/// The bits of a number mirrored behind the binary point: with k / n an even pattern (Hammersley).
double mirrored_bits(unsigned number) {
  double result = 0.0;
  for (double bit = 0.5; number != 0; number >>= 1, bit *= 0.5) {
    if ((number & 1u) != 0) result += bit;
  }
  return result;
}

class Tile {
 public:
  Tile(const TileShading& shading, const TileArea& area, Shader& shader)
      : s_(shading), area_(area), shader_(shader) {
    shader_.begin(shading);
  }

  /// `samples` a pixel, in a fixed pattern.
  void shade(Image& image) {
    const int count = s_.options.samples;
    for (int k = 0; k < area_.width * area_.height; ++k) {
      const double x = area_.left + k % area_.width;
      const double y = area_.upper + k / area_.width;
      for (int i = 0; i < count; ++i) {
        const double dx = (i + 0.5) / count;
        const double dy = mirrored_bits(static_cast<unsigned>(i)) + 0.5 / count;
        shader_.send(x + dx, y + std::fmod(dy, 1.0));
      }
    }
    shader_.gather();
    write(image);
  }

  /// Through the middle of each pixel.
  void shoot(const FrameParts& parts, Frame& frame) {
    const bool every_one = parts.depth || parts.ids || !s_.options.quickly;
    if (every_one) send_all();
    if (parts.depth || parts.ids) write_hits(parts, frame);
    if (!parts.light) return;
    if (s_.options.quickly) {
      shoot_every_other(frame);
      return;
    }
    shader_.gather();
    for (std::size_t k = 0; k < shader_.samples().size(); ++k) {
      frame.light[index_in(frame, k)] = shader_.samples()[k].light;
    }
  }

 private:
  std::size_t index_in(const Frame& frame, std::size_t pixel) const {
    const int k = static_cast<int>(pixel);
    return frame.index(area_.left + k % area_.width, area_.upper + k / area_.width);
  }

  void send_all() {
    for (int k = 0; k < area_.width * area_.height; ++k) {
      shader_.send(area_.left + k % area_.width + 0.5, area_.upper + k / area_.width + 0.5);
    }
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

  /// Looks through each second pixel each way, and through those between where their neighbours are
  /// not of one smooth surface in one light.
  void shoot_every_other(Frame& frame) {
    shader_.clear();
    columns_ = area_.width / 2 + area_.width % 2 + 1;
    const int rows = area_.height / 2 + area_.height % 2 + 1;
    // Each second corner first, as on a chessboard: the others have neighbours then.
    grid_.resize(static_cast<std::size_t>(columns_ * rows));
    send_corners(rows, 0);
    shader_.gather();
    send_corners(rows, 1);
    shader_.gather();
    between_.clear();
    for (int row = 0; row + 1 < rows; ++row) {
      for (int column = 0; column + 1 < columns_; ++column) fill_square(column, row, frame);
    }
    shader_.gather();
    for (const auto& [place, sample] : between_) {
      frame.light[place] = shader_.samples()[sample].light;
    }
  }

  /// The black or the white ones; in blocks, so that rays that go together are close together.
  void send_corners(int rows, int colour) {
    for (int upper = 0; upper < rows; upper += 4) {
      for (int left = 0; left < columns_; left += 4) {
        for (int k = 0; k < 16; ++k) {
          const int column = left + k % 4;
          const int row = upper + k / 4;
          if ((column + row) % 2 != colour || column >= columns_ || row >= rows) continue;
          Neighbours beside;
          std::size_t count = 0;
          const auto add = [&](int c, int r) {
            if (c >= 0 && r >= 0 && c < columns_ && r < rows)
              beside.samples[count++] = corner(c, r);
          };
          if (colour == 1) {
            add(column - 1, row);
            add(column + 1, row);
            add(column, row - 1);
            add(column, row + 1);
          }
          grid_[static_cast<std::size_t>(row * columns_ + column)] =
              static_cast<std::uint32_t>(shader_.samples().size());
          shader_.send(area_.left + 2 * column + 0.5, area_.upper + 2 * row + 0.5, beside);
        }
      }
    }
  }

  std::uint32_t corner(int column, int row) const {
    return grid_[static_cast<std::size_t>(row * columns_ + column)];
  }

  /// The pixels of a square of two by two whose first is a corner.
  void fill_square(int column, int row, Frame& frame) {
    const std::uint32_t corners[4] = {corner(column, row), corner(column + 1, row),
                                      corner(column, row + 1), corner(column + 1, row + 1)};
    const auto light = [&](int k) -> const Eigen::Vector3f& {
      return shader_.samples()[corners[k]].light;
    };
    for (int k = 0; k < 4; ++k) {
      const int x = area_.left + 2 * column + k % 2;
      const int y = area_.upper + 2 * row + k / 2;
      if (x >= area_.left + area_.width || y >= area_.upper + area_.height) continue;
      const std::size_t place = frame.index(x, y);
      if (k == 0) {
        frame.light[place] = light(0);
      } else if (k < 3 && is_even(corners[0], corners[k])) {
        frame.light[place] = 0.5f * (light(0) + light(k));
      } else if (k == 3 && is_even(corners)) {
        frame.light[place] = 0.25f * (light(0) + light(1) + light(2) + light(3));
      } else {
        shader_.send(x + 0.5, y + 0.5, neighbours(corners, k));
        between_.emplace_back(place, shader_.samples().size() - 1);
      }
    }
  }

  /// Of pixel k of a square between these corners.
  static Neighbours neighbours(const std::uint32_t corners[4], int k) {
    Neighbours all{{corners[0], corners[1], corners[2], corners[3]}};
    return k == 3 ? all : Neighbours{{corners[0], corners[k], Neighbours::kNone}};
  }

  bool is_even(std::uint32_t a, std::uint32_t b) const {
    const Eigen::Vector3f change = shader_.samples()[a].light - shader_.samples()[b].light;
    return same_surface(shader_.seen(a), shader_.seen(b)) &&
           change.cwiseAbs().maxCoeff() <= kSameLight;
  }

  bool is_even(const std::uint32_t corners[4]) const {
    if (!is_even(corners[0], corners[3]) || !is_even(corners[1], corners[2]) ||
        !is_even(corners[0], corners[1])) {
      return false;
    }
    const auto range_m = [&](int k) { return shader_.seen(corners[k]).range_m; };
    const float bend_m = range_m(0) + range_m(3) - range_m(1) - range_m(2);
    return std::abs(bend_m) <= kSameRange * range_m(0);
  }

  void write_hits(const FrameParts& parts, Frame& frame) const {
    const std::vector<SceneRay>& rays = shader_.rays();
    std::vector<RayHit> hits(rays.size());
    s_.rays.meet(rays.data(), rays.size(), hits.data());
    const std::vector<Sample>& samples = shader_.samples();
    std::vector<RayHit> of_pixel(samples.size());
    for (std::size_t i = 0; i < rays.size(); ++i) of_pixel[shader_.owners()[i]] = hits[i];
    for (std::size_t k = 0; k < of_pixel.size(); ++k) {
      const RayHit& hit = of_pixel[k];
      const bool met = hit.entity != kNoEntity;
      const std::size_t at = index_in(frame, k);
      if (parts.depth) {
        const double range_m = samples[k].travelled_m + static_cast<double>(hit.range_m);
        frame.depth_m[at] = met ? static_cast<float>(range_m / samples[k].stretch)
                                : std::numeric_limits<float>::infinity();
      }
      if (parts.ids) {
        frame.entities[at] = hit.entity;
        frame.labels[at] = static_cast<std::uint16_t>(hit.label);
      }
    }
  }

  const TileShading& s_;
  const TileArea area_;
  Shader& shader_;
  int columns_ = 0;                                           // of the grid of corners
  std::vector<std::uint32_t> grid_;                           // the corners' samples
  std::vector<std::pair<std::size_t, std::size_t>> between_;  // places in the frame, and samples
};

}  // namespace

void shade_tile(const TileShading& shading, const TileArea& area, Shader& shader, Image& image) {
  Tile(shading, area, shader).shade(image);
}

void shoot_tile(const TileShading& shading, const TileArea& area, const FrameParts& parts,
                Shader& shader, Frame& frame) {
  Tile(shading, area, shader).shoot(parts, frame);
}

}  // namespace ardee
