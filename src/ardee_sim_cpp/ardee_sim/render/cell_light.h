// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ardee_sim/raycast/glance.h"
#include "ardee_sim/render/light_store.h"
#include "ardee_sim/render/shader.h"

namespace ardee {

/// The light of what was glanced at, cell by cell: a camera sees most cells again and again, and
/// only what is not in the store is shaded. The room of one call is used for the next.
class CellLight {
 public:
  /// How wide the cell may be that a pixel sees a metre away, straight on.
  static float width_m(const TileShading& shading);

  /// What is known of a request's light.
  struct Found {
    Eigen::Vector3f light;
    bool met = false;  // else it is not that of a cell
  };
  const std::vector<Found>& gather(const TileShading& shading,
                                   const std::vector<GlanceBlock>& blocks,
                                   const std::vector<CellRequest>& requests, Shader& shader);

 private:
  void find_cells(const TileShading& shading, const std::vector<GlanceBlock>& blocks,
                  const std::vector<CellRequest>& requests, const Shader& shader);
  void shade_missed(const TileShading& shading, Shader& shader);

  std::vector<SurfaceCell> cells_;
  std::vector<LightStore::Name> names_;
  std::vector<Found> found_;
  std::vector<std::size_t> missed_;  // cells that are not in the store
};

}  // namespace ardee
