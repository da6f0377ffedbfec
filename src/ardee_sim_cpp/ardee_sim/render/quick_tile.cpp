// SPDX-License-Identifier: MIT
#include "ardee_sim/render/quick_tile.h"

#include <algorithm>
#include <cmath>

namespace ardee {
namespace {

/// Pixels between those of the coarsest lattice; blocks of rays have as many pixels each way.
constexpr int kCoarsest_px = 4;
/// Light of pixels two pixels apart is taken for what lies between if it differs by less; of those
/// farther apart it may differ by a quarter of it.
constexpr float kSameLight = 0.1f;
/// Normals of a surface within this cosine are of a place where it is smooth.
constexpr float kSmooth = 0.85f;
/// Ranges along one surface that differ by more, as a share, are not next to each other.
constexpr float kSameRange = 0.02f;
/// In place of a surface where the lens lets no light through.
constexpr std::uint32_t kDark = 1;
/// Brighter than anything.
constexpr float kGlare = 1e30f;

/// Pixels of even columns and rows: of each row, and in all. The lattice ends one beyond the tile.
constexpr std::size_t kInRow = QuickTile::kMostSide_px / 2 + 1;
constexpr std::size_t kInAll = kInRow * kInRow;

int whole_blocks(int pixels) { return (pixels + kCoarsest_px - 1) / kCoarsest_px * kCoarsest_px; }

std::uint32_t all_if(bool condition) { return condition ? ~0u : 0u; }

/// One colour of some pixels' light.
struct Channel {
  float sum = 0.0f;
  float least = kGlare;
  float greatest = -kGlare;

  /// `share` is 1 if the pixel counts, else 0.
  void add(float light, float share) {
    const float glare = (1.0f - share) * kGlare;
    const float low = light + glare;
    const float high = light - glare;
    sum += share * light;
    least = low < least ? low : least;
    greatest = high > greatest ? high : greatest;
  }
  float spread() const { return greatest - least; }
};

}  // namespace

void QuickTile::Pixels::resize(std::size_t count) {
  for (auto* list : {&normal_x_W, &normal_y_W, &normal_z_W, &range_m, &red, &green, &blue}) {
    list->resize(count);
  }
  for (auto* list : {&surface, &triangle, &ray, &known, &in_shadow}) list->resize(count);
}

std::size_t QuickTile::place(int x, int y) {
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  return (column % 2 + row % 2 * 2) * kInAll + row / 2 * kInRow + column / 2;
}

void QuickTile::shade(const TileShading& shading, const TileArea& area, Shader& shader,
                      Frame& frame) {
  s_ = &shading;
  shader_ = &shader;
  area_ = area;
  const int width = whole_blocks(area.width);
  const int height = whole_blocks(area.height);
  if (width != width_ || height != height_) lay_out(width, height);
  glance_all();
  for (int y = 0; y <= height_; y += kCoarsest_px) {
    for (int x = 0; x <= width_; x += kCoarsest_px) send(place(x, y), {});
  }
  gather();
  const Lattice coarse{place(0, 0), place(2, 2), place(2, 0), place(0, 2), 2,
                       2 * kInRow,  width_ / 4,  height_ / 4, true};
  refine(coarse, 0.25f * kSameLight);
  const Lattice fine{place(0, 0), place(1, 1), place(1, 0), place(0, 1), 1,
                     kInRow,      width_ / 2,  height_ / 2, false};
  refine(fine, kSameLight);
  write(frame);
}

void QuickTile::lay_out(int width, int height) {
  width_ = width;
  height_ = height;
  std::vector<Eigen::Vector2i> pixels;
  for (int y = 0; y < height_; y += kCoarsest_px) {
    for (int x = 0; x < width_; x += kCoarsest_px) {
      for (int k = 0; k < GlanceBlock::kRays; ++k) {
        pixels.emplace_back(x + k % kCoarsest_px, y + k / kCoarsest_px);
      }
    }
  }
  for (int y = 0; y <= height_; y += 2) pixels.emplace_back(width_, y);
  for (int x = 0; x < width_; x += 2) pixels.emplace_back(x, height_);
  while (pixels.size() % GlanceBlock::kRays != 0) pixels.push_back(pixels.back());
  layout_.resize(pixels.size() / GlanceBlock::kRays);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    BlockLayout& block = layout_[k / GlanceBlock::kRays];
    const std::size_t i = k % GlanceBlock::kRays;
    block.x_px[i] = static_cast<float>(pixels[k].x());
    block.y_px[i] = static_cast<float>(pixels[k].y());
    block.places[i] = static_cast<std::uint32_t>(place(pixels[k].x(), pixels[k].y()));
  }
  blocks_.resize(layout_.size());
  pixels_.resize(4 * kInAll);
}

void QuickTile::glance_all() {
  set_rays();
  s_->rays.glance(s_->camera.X_WC.p, blocks_.data(), blocks_.size());
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    const GlanceBlock& block = blocks_[number];
    for (int i = 0; i < GlanceBlock::kRays; ++i) {
      const std::uint32_t place = layout_[number].places[i];
      pixels_.normal_x_W[place] = block.normal_x_W[i];
      pixels_.normal_y_W[place] = block.normal_y_W[i];
      pixels_.normal_z_W[place] = block.normal_z_W[i];
      pixels_.range_m[place] = block.met(i) ? block.range_m[i] : 0.0f;
      pixels_.surface[place] = block.far_m[i] > 0.0f ? block.surface[i] : kDark;
      pixels_.triangle[place] = block.triangle[i];
      pixels_.ray[place] =
          static_cast<std::uint32_t>(number) * GlanceBlock::kRays + static_cast<std::uint32_t>(i);
    }
  }
}

void QuickTile::set_rays() {
  const Eigen::Matrix3d R_WC = s_->camera.X_WC.q.toRotationMatrix();
  const auto way_W = [&](float x_px, float y_px) -> Eigen::Vector3f {
    const Eigen::Vector3d way_C =
        s_->camera.direction_C(area_.left + static_cast<double>(x_px) + 0.5,
                               area_.upper + static_cast<double>(y_px) + 0.5);
    return (R_WC * way_C).cast<float>();
  };
  const Eigen::Vector3f first = way_W(0, 0);
  const Eigen::Vector3f right = way_W(1, 0) - first;
  const Eigen::Vector3f down = way_W(0, 1) - first;
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    GlanceBlock& block = blocks_[number];
    const BlockLayout& layout = layout_[number];
    for (int i = 0; i < GlanceBlock::kRays; ++i) {
      block.x_W[i] = first.x() + layout.x_px[i] * right.x() + layout.y_px[i] * down.x();
      block.y_W[i] = first.y() + layout.x_px[i] * right.y() + layout.y_px[i] * down.y();
      block.z_W[i] = first.z() + layout.x_px[i] * right.z() + layout.y_px[i] * down.z();
    }
    for (int i = 0; i < GlanceBlock::kRays && !s_->camera.is_straight(); ++i) {
      block.set_direction(i, way_W(layout.x_px[i], layout.y_px[i]));
    }
    make_unit(block);
  }
}

/// Sets the ends of rays whose directions are of length 1 along the camera's axis.
void QuickTile::make_unit(GlanceBlock& block) const {
  const auto near_m = static_cast<float>(s_->camera.near_m);
  const auto far_m = static_cast<float>(s_->camera.far_m);
  const auto most_m = static_cast<float>(s_->options.max_range_m);
  for (int i = 0; i < GlanceBlock::kRays; ++i) {
    const float x = block.x_W[i];
    const float y = block.y_W[i];
    const float z = block.z_W[i];
    const float stretch = std::sqrt(x * x + y * y + z * z);
    const float share = 1.0f / stretch;
    block.x_W[i] = x * share;
    block.y_W[i] = y * share;
    block.z_W[i] = z * share;
    block.near_m[i] = near_m * stretch;
    block.far_m[i] = std::min(far_m * stretch, most_m);
  }
  for (int i = 0; i < GlanceBlock::kRays && !s_->camera.is_straight(); ++i) {
    if (std::isfinite(block.x_W[i])) continue;
    block.set_direction(i, {1, 0, 0});
    block.near_m[i] = block.far_m[i] = 0.0f;
  }
}

void QuickTile::refine(const Lattice& lattice, float most) {
  fill_middles(lattice, most);
  gather();
  fill_sides(lattice, most);
  gather();
}

void QuickTile::fill_middles(const Lattice& lattice, float most) {
  for (int k = 0; k < lattice.rows; ++k) {
    const std::size_t row = static_cast<std::size_t>(k) * lattice.row;
    const std::size_t corner = lattice.corner + row;
    const std::size_t lower = corner + lattice.row;
    fill(lattice, lattice.middle + row,
         {corner, corner + lattice.column, lower, lower + lattice.column}, lattice.columns, most,
         !lattice.coarse);
  }
}

void QuickTile::fill_sides(const Lattice& lattice, float most) {
  const std::size_t column = lattice.column;
  for (int k = 0; k < lattice.rows + (lattice.coarse ? 1 : 0); ++k) {
    const std::size_t row = static_cast<std::size_t>(k) * lattice.row;
    const std::size_t corner = lattice.corner + row;
    const std::size_t middle = lattice.middle + row;
    const bool between = k > 0 && k < lattice.rows;
    fill(lattice, lattice.upper + row,
         {corner, corner + column, between ? middle - lattice.row : corner,
          between ? middle : corner + column},
         lattice.columns, most, true);
  }
  for (int k = 0; k < lattice.rows; ++k) {
    const std::size_t row = static_cast<std::size_t>(k) * lattice.row;
    const std::size_t corner = lattice.corner + row;
    const std::size_t lower = corner + lattice.row;
    const std::size_t middle = lattice.middle + row;
    const std::size_t left = lattice.left + row;
    fill(lattice, left, {corner, lower, corner, lower}, 1, most, true);
    fill(lattice, left + column, {corner + column, lower + column, middle, middle + column},
         lattice.columns - 1, most, true);
    if (!lattice.coarse) continue;
    const std::size_t end = static_cast<std::size_t>(lattice.columns) * column;
    fill(lattice, left + end, {corner + end, lower + end, corner + end, lower + end}, 1, most,
         true);
  }
}

void QuickTile::fill(const Lattice& lattice, std::size_t first, const Neighbours& around, int count,
                     float most, bool ask_for_shadows) {
  if (lattice.column == 1) {
    fill_row<1>(first, around, count, most, ask_for_shadows);
  } else {
    fill_row<2>(first, around, count, most, ask_for_shadows);
  }
}

/// Without branches: neighbours differ as they like, and several pixels can go together.
template <std::size_t kColumn>
void QuickTile::fill_row(std::size_t first, const Neighbours& around, int count, float most,
                         bool ask_for_shadows) {
  const Pixels& p = pixels_;
  float reds[kInRow], greens[kInRow], blues[kInRow];
  std::uint32_t known[kInRow], in_shadow[kInRow], even[kInRow];
  for (int i = 0; i < count; ++i) {
    const std::size_t mine = first + static_cast<std::size_t>(i) * kColumn;
    Channel of_red, of_green, of_blue;
    float shares = 0.0f;
    float off_m = 0.0f;
    std::uint32_t lit = 0, dark = 0, unknown = 0;
    const auto add = [&](std::size_t start) {
      const std::size_t other = start + static_cast<std::size_t>(i) * kColumn;
      const float along = p.normal_x_W[mine] * p.normal_x_W[other] +
                          p.normal_y_W[mine] * p.normal_y_W[other] +
                          p.normal_z_W[mine] * p.normal_z_W[other];
      const std::uint32_t same =
          all_if(p.surface[mine] == p.surface[other]) &
          (all_if(p.triangle[mine] == p.triangle[other]) | all_if(along >= kSmooth));
      const float share = same != 0 ? 1.0f : 0.0f;
      of_red.add(p.red[other], share);
      of_green.add(p.green[other], share);
      of_blue.add(p.blue[other], share);
      shares += share;
      const float farther_m = p.range_m[other] - p.range_m[mine];
      off_m += share * farther_m;
      const std::uint32_t near = same & all_if(std::abs(farther_m) <= kSameRange * p.range_m[mine]);
      lit |= near & p.known[other] & ~p.in_shadow[other];
      dark |= near & p.known[other] & p.in_shadow[other];
      unknown |= near & ~p.known[other];
    };
    add(around[0]);
    add(around[1]);
    add(around[2]);
    add(around[3]);
    const float scale = 1.0f / shares;
    reds[i] = scale * of_red.sum;
    greens[i] = scale * of_green.sum;
    blues[i] = scale * of_blue.sum;
    known[i] = (lit ^ dark) & ~unknown;
    in_shadow[i] = dark & known[i];
    even[i] = all_if(shares > 0.0f) & all_if(of_red.spread() <= most) &
              all_if(of_green.spread() <= most) & all_if(of_blue.spread() <= most) &
              all_if(std::abs(off_m) <= kSameRange * p.range_m[mine] * shares);
  }
  for (int i = 0; i < count; ++i) {
    const std::size_t mine = first + static_cast<std::size_t>(i) * kColumn;
    pixels_.red[mine] = reds[i];
    pixels_.green[mine] = greens[i];
    pixels_.blue[mine] = blues[i];
    pixels_.known[mine] = known[i];
    pixels_.in_shadow[mine] = in_shadow[i];
    if (even[i] != 0) continue;
    send(mine, ask_for_shadows ? LampKnowledge{known[i], in_shadow[i]} : LampKnowledge{});
  }
}

void QuickTile::send(std::size_t place, const LampKnowledge& lamps) {
  if (pixels_.surface[place] == kDark) {
    pixels_.red[place] = pixels_.green[place] = pixels_.blue[place] = 0.0f;
    return;
  }
  const std::uint32_t ray = pixels_.ray[place];
  shader_->send(blocks_[ray / GlanceBlock::kRays], static_cast<int>(ray % GlanceBlock::kRays),
                lamps);
  sent_.push_back(place);
}

void QuickTile::gather() {
  shader_->gather();
  for (std::size_t k = 0; k < sent_.size(); ++k) {
    const Sample& sample = shader_->samples()[k];
    pixels_.red[sent_[k]] = sample.light.x();
    pixels_.green[sent_[k]] = sample.light.y();
    pixels_.blue[sent_[k]] = sample.light.z();
    pixels_.known[sent_[k]] = sample.lamps.known;
    pixels_.in_shadow[sent_[k]] = sample.lamps.in_shadow;
  }
  sent_.clear();
  shader_->clear();
}

void QuickTile::write(Frame& frame) const {
  for (int y = 0; y < area_.height; ++y) {
    Eigen::Vector3f* row = &frame.light[frame.index(area_.left, area_.upper + y)];
    for (const int first : {0, 1}) {
      std::size_t k = place(first, y);
      for (int x = first; x < area_.width; x += 2, ++k) {
        row[x] = {pixels_.red[k], pixels_.green[k], pixels_.blue[k]};
      }
    }
  }
}

}  // namespace ardee
