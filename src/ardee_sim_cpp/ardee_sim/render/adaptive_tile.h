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

/// The light of a tile's pixels, one ray through the middle of each, as quickly as it can be had.
/// The primary rays of all pixels are traced; a coarse grid of pixels is shaded, and the grid is
/// then made finer step by step: a pixel whose neighbours on the coarser grid are of its own
/// surface and of one light takes theirs, and the others are shaded. The room of one tile is used
/// for the next.
class AdaptiveTile {
 public:
  /// Up to so many pixels each way.
  static constexpr int kMostSide_px = 32;

  void shade(const TileShading& shading, const TileArea& area, Shader& shader, Frame& frame);

 private:
  /// Where the rays of a block belong.
  struct BlockLayout {
    float x_px[raycast::PrimaryRayPacket::kRays];
    float y_px[raycast::PrimaryRayPacket::kRays];
    std::uint32_t places[raycast::PrimaryRayPacket::kRays];
  };
  /// What is known of the pixels, a list of each number. Pixels of even columns and rows come
  /// first, then odd columns, odd rows, and both: so those that are worked on together lie side by
  /// side.
  struct Pixels {
    std::vector<float> normal_x_W, normal_y_W, normal_z_W;
    std::vector<float> range_m;  // 0: nothing was met
    std::vector<float> red, green, blue;
    std::vector<std::uint32_t> surface, triangle;
    std::vector<std::uint32_t> ray;  // its number among those of all blocks
    std::vector<std::uint32_t> known, in_shadow;

    void resize(std::size_t count);
  };
  /// A pixel whose light is wanted, and what its neighbours know of shadows there.
  struct Sent {
    std::size_t place;
    LampKnowledge lamps;
  };
  /// A lattice to be made finer: where its first corner lies, and the first middle of a square, of
  /// an upper and of a left side; how far it is to the next ones; how many squares there are.
  struct GridLevel {
    std::size_t corner, middle, upper, left;
    std::size_t column, row;
    int columns, rows;
    bool coarse;  // its last corners' sides belong to it; too far apart to tell of shadows
  };
  /// Where the first of some pixels in a row has its neighbours; those of the others are next to
  /// them.
  using Neighbours = NeighbourInterpolation::Neighbours;

  static std::size_t place(int x, int y);
  /// Which pixels are seen through the rays of each block: squares, then what the lattice ends
  /// with.
  void lay_out(int width, int height);
  void trace_all_primary();
  void set_rays();
  /// Sets the ends of rays whose directions are of length 1 along the camera's axis.
  void make_unit(raycast::PrimaryRayPacket& block) const;
  void refine(const GridLevel& lattice, float most);
  void fill_middles(const GridLevel& lattice, float most);
  void fill_sides(const GridLevel& lattice, float most);
  void fill(const GridLevel& lattice, std::size_t first, const Neighbours& around, int count,
            float most, bool ask_for_shadows);
  void enqueue(std::size_t place, const LampKnowledge& lamps);
  /// The light of those that were sent.
  void flush();
  void set(std::size_t place, const Eigen::Vector3f& light, const LampKnowledge& lamps);
  void write(Frame& frame) const;

  const TileShading* s_ = nullptr;
  Shader* shader_ = nullptr;
  TileArea area_;
  float cell_width_ = 0.0f;  // for each metre away
  int width_ = 0;            // in whole blocks
  int height_ = 0;
  std::vector<BlockLayout> layout_;
  std::vector<raycast::PrimaryRayPacket> blocks_;
  Pixels pixels_;
  std::vector<Sent> sent_;
  std::vector<raycast::TexelRequest> requests_;  // of each that was sent
  std::vector<std::size_t> looked_at_;           // the place of each sample
  CachedShading cached_shading_;
};

}  // namespace ardee::render
