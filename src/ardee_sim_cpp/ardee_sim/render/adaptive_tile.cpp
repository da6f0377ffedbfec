// SPDX-License-Identifier: MIT
#include "ardee_sim/render/adaptive_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardee::render {
namespace {

/// Distance of pixels in the coarsest lattice; a block of rays has as many pixels each way.
constexpr int kCoarsest_px = 4;
/// Greatest difference of light between pixels two pixels apart that share their light with those
/// between; for pixels farther apart, a quarter of it.
constexpr float kSameLight = 0.1f;
/// Surface number of pixels where the lens lets no light through.
constexpr std::uint32_t kDark = 1;

/// Number of pixels of even columns and rows, in each row and in all. The lattice ends one pixel
/// beyond the tile.
constexpr std::size_t kInRow = AdaptiveTile::kMostSide_px / 2 + 1;
constexpr std::size_t kInAll = kInRow * kInRow;
static_assert(NeighbourInterpolation::kMost == AdaptiveTile::kMostSide_px / 2,
              "a row of a lattice goes at once");

int whole_blocks(int pixels) { return (pixels + kCoarsest_px - 1) / kCoarsest_px * kCoarsest_px; }

}  // namespace

void AdaptiveTile::Pixels::resize(std::size_t count) {
  for (auto* list : {&normal_x_W, &normal_y_W, &normal_z_W, &range_m, &red, &green, &blue}) {
    list->resize(count);
  }
  for (auto* list : {&surface, &triangle, &ray, &known, &in_shadow}) list->resize(count);
}

std::size_t AdaptiveTile::place(int x, int y) {
  const auto column = static_cast<std::size_t>(x);
  const auto row = static_cast<std::size_t>(y);
  return (column % 2 + row % 2 * 2) * kInAll + row / 2 * kInRow + column / 2;
}

void AdaptiveTile::shade(const TileShading& shading, const TileArea& area, Shader& shader,
                         Frame& frame) {
  s_ = &shading;
  shader_ = &shader;
  area_ = area;
  cell_width_ = CachedShading::width_m(shading);
  const int width = whole_blocks(area.width);
  const int height = whole_blocks(area.height);
  if (width != width_ || height != height_) lay_out(width, height);
  trace_all_primary();
  for (int y = 0; y <= height_; y += kCoarsest_px) {
    for (int x = 0; x <= width_; x += kCoarsest_px) enqueue(place(x, y), {});
  }
  flush();
  const GridLevel coarse{place(0, 0), place(2, 2), place(2, 0), place(0, 2), 2,
                         2 * kInRow,  width_ / 4,  height_ / 4, true};
  refine(coarse, 0.25f * kSameLight);
  const GridLevel fine{place(0, 0), place(1, 1), place(1, 0), place(0, 1), 1,
                       kInRow,      width_ / 2,  height_ / 2, false};
  refine(fine, kSameLight);
  write(frame);
}

float AdaptiveTile::nearest_m() const {
  const Eigen::Vector3f ahead_W = (s_->camera.X_WC.q * Eigen::Vector3d::UnitX()).cast<float>();
  float nearest = std::numeric_limits<float>::infinity();
  for (const raycast::PrimaryRayPacket& block : blocks_) {
    for (int i = 0; i < raycast::PrimaryRayPacket::kRays; ++i) {
      if (!block.met(i)) continue;
      nearest = std::min(nearest, block.range_m[i] * ahead_W.dot(block.direction_W(i)));
    }
  }
  return nearest;
}

void AdaptiveTile::lay_out(int width, int height) {
  width_ = width;
  height_ = height;
  std::vector<Eigen::Vector2i> pixels;
  for (int y = 0; y < height_; y += kCoarsest_px) {
    for (int x = 0; x < width_; x += kCoarsest_px) {
      for (int k = 0; k < raycast::PrimaryRayPacket::kRays; ++k) {
        pixels.emplace_back(x + k % kCoarsest_px, y + k / kCoarsest_px);
      }
    }
  }
  for (int y = 0; y <= height_; y += 2) pixels.emplace_back(width_, y);
  for (int x = 0; x < width_; x += 2) pixels.emplace_back(x, height_);
  while (pixels.size() % raycast::PrimaryRayPacket::kRays != 0) pixels.push_back(pixels.back());
  layout_.resize(pixels.size() / raycast::PrimaryRayPacket::kRays);
  for (std::size_t k = 0; k < pixels.size(); ++k) {
    BlockLayout& block = layout_[k / raycast::PrimaryRayPacket::kRays];
    const std::size_t i = k % raycast::PrimaryRayPacket::kRays;
    block.x_px[i] = static_cast<float>(pixels[k].x());
    block.y_px[i] = static_cast<float>(pixels[k].y());
    block.places[i] = static_cast<std::uint32_t>(place(pixels[k].x(), pixels[k].y()));
  }
  blocks_.resize(layout_.size());
  pixels_.resize(4 * kInAll + NeighbourInterpolation::kMost);
}

void AdaptiveTile::trace_all_primary() {
  set_rays();
  s_->rays.trace_primary(s_->camera.X_WC.p, blocks_.data(), blocks_.size());
  for (std::size_t number = 0; number < blocks_.size(); ++number) {
    const raycast::PrimaryRayPacket& block = blocks_[number];
    for (int i = 0; i < raycast::PrimaryRayPacket::kRays; ++i) {
      const std::uint32_t place = layout_[number].places[i];
      pixels_.normal_x_W[place] = block.normal_x_W[i];
      pixels_.normal_y_W[place] = block.normal_y_W[i];
      pixels_.normal_z_W[place] = block.normal_z_W[i];
      pixels_.range_m[place] = block.met(i) ? block.range_m[i] : 0.0f;
      pixels_.surface[place] = block.far_m[i] > 0.0f ? block.surface[i] : kDark;
      pixels_.triangle[place] = block.triangle[i];
      pixels_.ray[place] = static_cast<std::uint32_t>(number) * raycast::PrimaryRayPacket::kRays +
                           static_cast<std::uint32_t>(i);
    }
  }
}

void AdaptiveTile::set_rays() {
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
    raycast::PrimaryRayPacket& block = blocks_[number];
    const BlockLayout& layout = layout_[number];
    for (int i = 0; i < raycast::PrimaryRayPacket::kRays; ++i) {
      block.x_W[i] = first.x() + layout.x_px[i] * right.x() + layout.y_px[i] * down.x();
      block.y_W[i] = first.y() + layout.x_px[i] * right.y() + layout.y_px[i] * down.y();
      block.z_W[i] = first.z() + layout.x_px[i] * right.z() + layout.y_px[i] * down.z();
    }
    for (int i = 0; i < raycast::PrimaryRayPacket::kRays && !s_->camera.is_straight(); ++i) {
      block.set_direction(i, way_W(layout.x_px[i], layout.y_px[i]));
    }
    make_unit(block);
  }
}

/// Sets the far ends of rays whose directions are of length 1 along the camera's axis.
void AdaptiveTile::make_unit(raycast::PrimaryRayPacket& block) const {
  const auto near_m = static_cast<float>(s_->camera.near_m);
  const auto far_m = static_cast<float>(s_->camera.far_m);
  const auto most_m = static_cast<float>(s_->options.max_range_m);
  for (int i = 0; i < raycast::PrimaryRayPacket::kRays; ++i) {
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
  for (int i = 0; i < raycast::PrimaryRayPacket::kRays && !s_->camera.is_straight(); ++i) {
    if (std::isfinite(block.x_W[i])) continue;
    block.set_direction(i, {1, 0, 0});
    block.near_m[i] = block.far_m[i] = 0.0f;
  }
}

void AdaptiveTile::refine(const GridLevel& lattice, float most) {
  fill_middles(lattice, most);
  flush();
  fill_sides(lattice, most);
  flush();
}

void AdaptiveTile::fill_middles(const GridLevel& lattice, float most) {
  for (int k = 0; k < lattice.rows; ++k) {
    const std::size_t row = static_cast<std::size_t>(k) * lattice.row;
    const std::size_t corner = lattice.corner + row;
    const std::size_t lower = corner + lattice.row;
    fill(lattice, lattice.middle + row,
         {corner, corner + lattice.column, lower, lower + lattice.column}, lattice.columns, most,
         !lattice.coarse);
  }
}

void AdaptiveTile::fill_sides(const GridLevel& lattice, float most) {
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

void AdaptiveTile::fill(const GridLevel& lattice, std::size_t first, const Neighbours& around,
                        int count, float most, bool ask_for_shadows) {
  const Pixels& p = pixels_;
  const NeighbourInterpolation::Lists lists{
      p.normal_x_W.data(), p.normal_y_W.data(), p.normal_z_W.data(), p.range_m.data(),
      p.red.data(),        p.green.data(),      p.blue.data(),       p.surface.data(),
      p.triangle.data(),   p.known.data(),      p.in_shadow.data()};
  NeighbourInterpolation of_row;
  of_row.find(lists, first, around, most);
  for (int k = 0; k < count; ++k) {
    const std::size_t i = static_cast<std::size_t>(k) * lattice.column;
    const std::size_t mine = first + i;
    pixels_.red[mine] = of_row.red[i];
    pixels_.green[mine] = of_row.green[i];
    pixels_.blue[mine] = of_row.blue[i];
    pixels_.known[mine] = of_row.known[i];
    pixels_.in_shadow[mine] = of_row.in_shadow[i];
    if (of_row.even[i] != 0) continue;
    enqueue(mine, ask_for_shadows ? LampKnowledge{of_row.known[i], of_row.in_shadow[i]}
                                  : LampKnowledge{});
  }
}

void AdaptiveTile::enqueue(std::size_t place, const LampKnowledge& lamps) {
  if (pixels_.surface[place] == kDark) {
    set(place, Eigen::Vector3f::Zero(), {});
    return;
  }
  // The numbers are written one by one in place: a copy of a whole struct would wait until its
  // parts are written.
  Sent& sent = sent_.emplace_back();
  sent.place = place;
  sent.lamps.known = lamps.known;
  sent.lamps.in_shadow = lamps.in_shadow;
  const std::uint32_t ray = pixels_.ray[place];
  const raycast::PrimaryRayPacket& block = blocks_[ray / raycast::PrimaryRayPacket::kRays];
  const std::size_t i = ray % raycast::PrimaryRayPacket::kRays;
  const float slant = block.x_W[i] * block.normal_x_W[i] + block.y_W[i] * block.normal_y_W[i] +
                      block.z_W[i] * block.normal_z_W[i];
  const float steep = std::max(std::abs(slant), static_cast<float>(kLeastSlant));
  const float width_m = cell_width_ * block.range_m[i] / std::sqrt(steep);
  raycast::TexelRequest& request = requests_.emplace_back();
  request.triangle = block.triangle[i];
  request.u = block.u[i];
  request.v = block.v[i];
  request.range_m = pixels_.range_m[place];
  request.width_m = std::copysign(width_m, -slant);
  request.ray = ray;
}

void AdaptiveTile::flush() {
  const auto& of_cells = cached_shading_.flush(*s_, blocks_, requests_, *shader_);
  looked_at_.clear();
  for (std::size_t k = 0; k < sent_.size(); ++k) {
    if (of_cells[k].met) {
      set(sent_[k].place, of_cells[k].light, {});
      continue;
    }
    const std::uint32_t ray = requests_[k].ray;
    shader_->enqueue(blocks_[ray / raycast::PrimaryRayPacket::kRays],
                     static_cast<int>(ray % raycast::PrimaryRayPacket::kRays), sent_[k].lamps);
    looked_at_.push_back(sent_[k].place);
  }
  shader_->flush();
  for (std::size_t k = 0; k < looked_at_.size(); ++k) {
    const Sample& sample = shader_->samples()[k];
    set(looked_at_[k], sample.light, sample.lamps);
  }
  sent_.clear();
  requests_.clear();
  shader_->clear();
}

void AdaptiveTile::set(std::size_t place, const Eigen::Vector3f& light,
                       const LampKnowledge& lamps) {
  pixels_.red[place] = light.x();
  pixels_.green[place] = light.y();
  pixels_.blue[place] = light.z();
  pixels_.known[place] = lamps.known;
  pixels_.in_shadow[place] = lamps.in_shadow;
}

void AdaptiveTile::write(Frame& frame) const {
  for (int y = 0; y < area_.height; ++y) {
    Eigen::Vector3f* row = &frame.light[frame.index(area_.left, area_.upper + y)];
    const std::size_t even = place(0, y);
    const std::size_t odd = place(1, y);
    for (int x = 0; x < area_.width; ++x) {
      const std::size_t k = (x % 2 == 0 ? even : odd) + static_cast<std::size_t>(x) / 2;
      row[x] = {pixels_.red[k], pixels_.green[k], pixels_.blue[k]};
    }
  }
}

}  // namespace ardee::render
