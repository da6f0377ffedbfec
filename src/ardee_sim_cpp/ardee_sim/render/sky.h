// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "ardee_sim/description/world.h"
#include "ardee_sim/render/sky_model.h"

namespace ardee::render {

/// Light of the sky: that of a daylight if there is one, else that of a world's scene.
class Sky {
 public:
  Sky(const Scene& scene, const std::optional<Daylight>& day);

  /// Returns the colour for a ray without a hit. A scene's sky is paler towards the horizon;
  /// without one it is the background.
  Eigen::Vector3f color(const Eigen::Vector3d& direction_W) const;
  /// Returns the ambient light on a surface with this normal. Under a sky, surfaces facing down get
  /// less; without one, the scene's ambient light is the same everywhere.
  Eigen::Vector3f ambient(const Eigen::Vector3d& normal_W) const;

 private:
  Scene scene_;
  std::optional<SkyModel> model_;
};

}  // namespace ardee::render
