// SPDX-License-Identifier: MIT
#include "ardee_sim/render/tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "ardee_sim/render/tone.h"

namespace ardee {
namespace {

/// Light between looks at one smooth surface is their mean if they differ by less.
constexpr float kSameLight = 0.1f;
/// Rays of a block of a picture, this many each way, go together.
constexpr int kBlock_px = 4;
/// In place of a surface where the lens lets no light through.
constexpr std::uint64_t kDark = 1;

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
    const bool quickly = parts.light && s_.options.quickly;
    if (parts.depth || parts.ids || !quickly) send_all();
    if (parts.depth || parts.ids) write_hits(parts, frame);
    if (quickly) shade_where_needed(frame);
    if (quickly || !parts.light) return;
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

  /// Of a pixel among those of all blocks, block by block. Blocks are whole, also where the tile
  /// ends within one.
  std::size_t at(int column, int row) const {
    constexpr unsigned kSide = kBlock_px;
    const auto x = static_cast<unsigned>(column);
    const auto y = static_cast<unsigned>(row);
    const unsigned block = y / kSide * static_cast<unsigned>(blocks_) + x / kSide;
    return block * kSide * kSide + y % kSide * kSide + x % kSide;
  }

  /// Glances through all pixels, shades each second of them each way, and of those between the ones
  /// whose neighbours are not of the same smooth surface in one light.
  void shade_where_needed(Frame& frame) {
    shader_.clear();
    glance_all();
    sample_of_.assign(rays_.size(), Neighbours::kNone);
    // Each second corner first, as on a chessboard: the others have neighbours then.
    for (const int colour : {0, 1}) {
      send_corners(colour);
      shader_.gather();
    }
    between_.clear();
    fill(frame);
    shader_.gather();
    for (const auto& [place, sample] : between_) {
      frame.light[place] = shader_.samples()[sample].light;
    }
  }

  void glance_all() {
    blocks_ = (area_.width + kBlock_px - 1) / kBlock_px;
    const int rows_of_blocks = (area_.height + kBlock_px - 1) / kBlock_px;
    const auto count = static_cast<std::size_t>(blocks_ * rows_of_blocks * kBlock_px * kBlock_px);
    rays_.resize(count);
    stretches_.resize(count);
    const Eigen::Matrix3d R_WC = s_.camera.X_WC.q.toRotationMatrix();
    const auto way_W = [&](int column, int row) -> Eigen::Vector3f {
      const Eigen::Vector3d way_C =
          s_.camera.direction_C(area_.left + column + 0.5, area_.upper + row + 0.5);
      return (R_WC * way_C).cast<float>();
    };
    const bool straight = s_.camera.is_straight();
    const Eigen::Vector3f first = way_W(0, 0);
    const Eigen::Vector3f right = way_W(1, 0) - first;
    const Eigen::Vector3f down = way_W(0, 1) - first;
    for (int block = 0; block < blocks_ * rows_of_blocks; ++block) {
      for (int k = 0; k < kBlock_px * kBlock_px; ++k) {
        const int column = block % blocks_ * kBlock_px + k % kBlock_px;
        const int row = block / blocks_ * kBlock_px + k / kBlock_px;
        set_ray(at(column, row), straight
                                     ? Eigen::Vector3f(first + static_cast<float>(column) * right +
                                                       static_cast<float>(row) * down)
                                     : way_W(column, row));
      }
    }
    glances_.resize(rays_.size());
    s_.rays.glance(s_.camera.X_WC.p, rays_.data(), rays_.size(), glances_.data());
    for (std::size_t k = 0; k < stretches_.size() && !straight; ++k) {
      if (stretches_[k] == 0.0f) glances_[k].surface = kDark;
    }
  }

  void set_ray(std::size_t place, const Eigen::Vector3f& way_W) {
    const float stretch = way_W.norm();  // length of the way for each metre along the camera's axis
    if (stretch < std::numeric_limits<float>::infinity()) {
      stretches_[place] = stretch;
      rays_[place] = {way_W * (1.0f / stretch), static_cast<float>(s_.camera.near_m) * stretch,
                      std::min(static_cast<float>(s_.camera.far_m) * stretch,
                               static_cast<float>(s_.options.max_range_m))};
    } else {
      stretches_[place] = 0.0f;
      rays_[place] = {{1, 0, 0}, 0.0f, 0.0f};
    }
  }

  /// Corners of squares are each second pixel, and the last.
  static bool is_corner(int k, int count) { return k % 2 == 0 || k + 1 == count; }

  std::uint32_t sample_of(int column, int row) const { return sample_of_[at(column, row)]; }

  void send_corners(int colour) {
    for (int row = 0; row < area_.height; ++row) {
      if (!is_corner(row, area_.height)) continue;
      for (int column = 0; column < area_.width; ++column) {
        if (!is_corner(column, area_.width)) continue;
        if (((column + 1) / 2 + (row + 1) / 2) % 2 != colour) continue;
        Neighbours beside;
        std::size_t count = 0;
        const auto add = [&](int c, int r) {
          if (c < 0 || r < 0 || c >= area_.width || r >= area_.height) return;
          const std::uint32_t sample = sample_of(c, r);
          if (sample != Neighbours::kNone) beside.samples[count++] = sample;
        };
        if (colour == 1) {
          add(column - 2, row);
          add(column + 2, row);
          add(column, row - 2);
          add(column, row + 2);
        }
        send(column, row, beside);
      }
    }
  }

  std::uint32_t send(int column, int row, const Neighbours& neighbours) {
    const std::size_t place = at(column, row);
    const auto sample = static_cast<std::uint32_t>(shader_.samples().size());
    if (glances_[place].surface == kDark) {
      shader_.send_dark();
    } else {
      shader_.send(rays_[place], stretches_[place], glances_[place], neighbours);
    }
    sample_of_[place] = sample;
    return sample;
  }

  /// A shaded pixel.
  struct Corner {
    Eigen::Array4f light;
    const Glance* glance;
    std::uint32_t sample;
  };

  static std::vector<int> corners(int count) {
    std::vector<int> found;
    for (int k = 0; k < count; ++k) {
      if (is_corner(k, count)) found.push_back(k);
    }
    return found;
  }

  void read_corners(const std::vector<int>& columns, int row, std::vector<Corner>& found) const {
    found.clear();
    for (const int column : columns) {
      const std::size_t place = at(column, row);
      const std::uint32_t sample = sample_of_[place];
      const Eigen::Vector3f& light = shader_.samples()[sample].light;
      found.push_back({{light.x(), light.y(), light.z(), 0.0f}, &glances_[place], sample});
    }
  }

  /// Corners have their own light, pixels between them that of two or four, or, later, that of a
  /// sample of their own.
  void fill(Frame& frame) {
    const std::vector<int> columns = corners(area_.width);
    const std::vector<int> rows = corners(area_.height);
    std::vector<Corner> upper;
    std::vector<Corner> lower;
    read_corners(columns, rows[0], lower);
    for (std::size_t j = 0; j < rows.size(); ++j) {
      upper.swap(lower);
      const bool row_between = j + 1 < rows.size() && rows[j + 1] == rows[j] + 2;
      if (j + 1 < rows.size()) read_corners(columns, rows[j + 1], lower);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const bool between = i + 1 < columns.size() && columns[i + 1] == columns[i] + 2;
        const int column = columns[i];
        const int row = rows[j];
        light_at(column, row, frame) = upper[i].light.head<3>();
        if (between) fill_from<2>(column + 1, row, {&upper[i], &upper[i + 1]}, frame);
        if (!row_between) continue;
        fill_from<2>(column, row + 1, {&upper[i], &lower[i]}, frame);
        if (!between) continue;
        fill_from<4>(column + 1, row + 1, {&upper[i], &upper[i + 1], &lower[i], &lower[i + 1]},
                     frame);
      }
    }
  }

  Eigen::Vector3f& light_at(int column, int row, Frame& frame) const {
    return frame.light[frame.index(area_.left + column, area_.upper + row)];
  }

  /// The mean light of the corners around that are of the pixel's own surface, if there are some
  /// and it is even there; else a sample of its own is sent.
  template <std::size_t N>
  void fill_from(int column, int row, const std::array<const Corner*, N>& around, Frame& frame) {
    const Glance& mine = glances_[at(column, row)];
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    Eigen::Array4f least = Eigen::Array4f::Constant(std::numeric_limits<float>::infinity());
    Eigen::Array4f most = -least;
    float off_m = 0.0f;  // of their ranges from mine, in the mean
    int count = 0;
    for (const Corner* corner : around) {
      if (!same_surface(mine, *corner->glance)) continue;
      least = least.min(corner->light);
      most = most.max(corner->light);
      sum += corner->light;
      if (mine.surface != 0) off_m += corner->glance->range_m - mine.range_m;
      ++count;
    }
    const float share = 1.0f / static_cast<float>(count);
    if (count > 0 && !(std::abs(share * off_m) > kSameRange * mine.range_m) &&
        !((most - least).maxCoeff() > kSameLight)) {
      light_at(column, row, frame) = share * sum.head<3>();
      return;
    }
    Neighbours beside;
    for (std::size_t k = 0; k < N; ++k) beside.samples[k] = around[k]->sample;
    between_.emplace_back(frame.index(area_.left + column, area_.upper + row),
                          send(column, row, beside));
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
  int blocks_ = 0;  // side by side
  std::vector<GlanceRay> rays_;
  std::vector<float> stretches_;  // 0: the lens lets no light through
  std::vector<Glance> glances_;
  std::vector<std::uint32_t> sample_of_;                        // of each pixel
  std::vector<std::pair<std::size_t, std::uint32_t>> between_;  // places in the frame, and samples
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
