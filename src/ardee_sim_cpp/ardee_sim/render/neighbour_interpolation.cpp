// SPDX-License-Identifier: MIT
#include "ardee_sim/render/neighbour_interpolation.h"

#include <cmath>

#include "ardee_sim/core/vector_clones.h"

namespace ardee::render {
namespace {

/// Least cosine between normals of a smooth surface.
constexpr float kSmooth = 0.85f;
/// Greatest difference of ranges of adjacent points on one surface, as a share.
constexpr float kSameRange = 0.02f;
/// Light brighter than any.
constexpr float kGlare = 1e30f;

std::uint32_t all_if(bool condition) { return condition ? ~0u : 0u; }

/// One colour of the light of some pixels.
struct Channel {
  float sum = 0.0f;
  float least = kGlare;
  float greatest = -kGlare;

  /// Adds light; `share` is 1 if the pixel counts, else 0.
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

/// Finds a row without branches: neighbours differ irregularly, and several pixels are processed at
/// once.
ARDEE_VECTOR_CLONES void find_row(const NeighbourInterpolation::Lists& p, std::size_t first,
                                  const NeighbourInterpolation::Neighbours& around, float most,
                                  NeighbourInterpolation& result) {
  NeighbourInterpolation row;  // local, so that no other pointer aliases it
  for (int i = 0; i < NeighbourInterpolation::kMost; ++i) {
    const std::size_t mine = first + static_cast<std::size_t>(i);
    Channel of_red, of_green, of_blue;
    float shares = 0.0f;
    float off_m = 0.0f;
    std::uint32_t lit = 0, dark = 0, unknown = 0;
    const auto add = [&](std::size_t start) {
      const std::size_t other = start + static_cast<std::size_t>(i);
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
    row.red[i] = scale * of_red.sum;
    row.green[i] = scale * of_green.sum;
    row.blue[i] = scale * of_blue.sum;
    row.known[i] = (lit ^ dark) & ~unknown;
    row.in_shadow[i] = dark & row.known[i];
    row.even[i] = all_if(shares > 0.0f) & all_if(of_red.spread() <= most) &
                  all_if(of_green.spread() <= most) & all_if(of_blue.spread() <= most) &
                  all_if(std::abs(off_m) <= kSameRange * p.range_m[mine] * shares);
  }
  result = row;
}

}  // namespace

void NeighbourInterpolation::find(const Lists& lists, std::size_t first, const Neighbours& around,
                                  float most) {
  find_row(lists, first, around, most, *this);
}

}  // namespace ardee::render
