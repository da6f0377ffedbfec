// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ardee_sim/raycast/primary_ray_packet.h"
#include "ardee_sim/render/cached_shading.h"
#include "ardee_sim/render/frame.h"
#include "ardee_sim/render/neighbour_interpolation.h"
#include "ardee_sim/render/shader.h"

namespace ardee::render {

/// Light of a tile's pixels, from one ray through the middle of each, computed as quickly as
/// possible. The primary rays of all pixels are traced; a coarse grid of pixels is shaded and then
/// refined step by step: a pixel takes the light of its neighbours on the coarser grid if they are
/// of its own surface and equally lit; all others are shaded. The next tile reuses the memory.
class AdaptiveTile {
 public:
  /// Greatest number of pixels each way.
  static constexpr int kMostSide_px = 32;

  void shade(const TileShading& shading, const TileArea& area, Shader& shader, Frame& frame);
  /// Returns the least distance along the camera's axis of what the last tile shows; +inf: nothing.
  float nearest_m() const;

 private:
  /// Pixels of the rays of a block.
  struct BlockLayout {
    float x_px[raycast::PrimaryRayPacket::kRays];
    float y_px[raycast::PrimaryRayPacket::kRays];
    std::uint32_t places[raycast::PrimaryRayPacket::kRays];
  };
  /// Data of the pixels, an array for each number. Pixels of even columns and rows come first, then
  /// odd columns, odd rows, and both: so pixels that are processed together are adjacent.
  struct Pixels {
    std::vector<float> normal_x_W, normal_y_W, normal_z_W;
    std::vector<float> range_m;  // 0: no hit
    std::vector<float> red, green, blue;
    std::vector<std::uint32_t> surface, triangle;
    std::vector<std::uint32_t> ray;  // its index among the rays of all blocks
    std::vector<std::uint32_t> known, in_shadow;

    void resize(std::size_t count);
  };
  /// Pixel to be shaded, with the shadows that its neighbours know.
  struct Sent {
    std::size_t place;
    LampKnowledge lamps;
  };
  /// Lattice to be refined: the places of its first corner, and of the first middle of a square, of
  /// an upper and of a left side; the distances to the next ones; the number of squares.
  struct GridLevel {
    std::size_t corner, middle, upper, left;
    std::size_t column, row;
    int columns, rows;
    bool coarse;  // its last corners' sides belong to it; too far apart to tell of shadows
  };
  /// Places of the neighbours of the first of some pixels in a row; the neighbours of the others
  /// follow.
  using Neighbours = NeighbourInterpolation::Neighbours;

  static std::size_t place(int x, int y);
  /// Assigns pixels to the rays of each block: squares first, then the end of the lattice.
  void lay_out(int width, int height);
  void trace_all_primary();
  void set_rays();
  /// Sets the far ends of rays whose directions are of length 1 along the camera's axis.
  void make_unit(raycast::PrimaryRayPacket& block) const;
  void refine(const GridLevel& lattice, float most);
  void fill_middles(const GridLevel& lattice, float most);
  void fill_sides(const GridLevel& lattice, float most);
  void fill(const GridLevel& lattice, std::size_t first, const Neighbours& around, int count,
            float most, bool ask_for_shadows);
  void enqueue(std::size_t place, const LampKnowledge& lamps);
  /// Shades the pixels that were sent.
  void flush();
  void set(std::size_t place, const Eigen::Vector3f& light, const LampKnowledge& lamps);
  void write(Frame& frame) const;

  const TileShading* s_ = nullptr;
  Shader* shader_ = nullptr;
  TileArea area_;
  float cell_width_ = 0.0f;  // at a distance of one metre
  int width_ = 0;            // whole blocks
  int height_ = 0;
  std::vector<BlockLayout> layout_;
  std::vector<raycast::PrimaryRayPacket> blocks_;
  Pixels pixels_;
  std::vector<Sent> sent_;
  std::vector<raycast::TexelRequest> requests_;  // one for each pixel that was sent
  std::vector<std::size_t> looked_at_;           // place of each sample
  CachedShading cached_shading_;
};

}  // namespace ardee::render
