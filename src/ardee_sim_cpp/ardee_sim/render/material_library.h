// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/raycast/surface_interaction.h"
#include "ardee_sim/render/texture.h"

namespace ardee::render {

/// Optical properties of a surface at a point: shares of red, green and blue; its own light.
struct SurfaceColor {
  Eigen::Vector3f ambient{0, 0, 0};
  Eigen::Vector3f diffuse{0, 0, 0};
  Eigen::Vector3f emissive{0, 0, 0};
  float opacity = 1.0f;
};

/// Materials of models with their textures, each loaded once. Many threads may read at once.
class MaterialLibrary {
 public:
  explicit MaterialLibrary(Log log) : log_(std::move(log)) {}

  /// Loads the textures of the model's visuals. A texture that cannot be read gives a warning, and
  /// white.
  void add(const std::shared_ptr<const Model>& model);

  /// Drops all models, but keeps textures for models that are added again.
  void clear();

  /// Result of the last look-up: neighbours in a picture are mostly of one surface.
  struct LookupCache {
    const Material* material = nullptr;
    const Texture* texture = nullptr;
    const Heightmap* map = nullptr;
    const std::vector<const Texture*>* layers = nullptr;
  };

  /// Returns the colour of a point of which a pixel covers `footprint_m`.
  SurfaceColor at(const raycast::SurfaceInteraction& point, double footprint_m,
                  LookupCache& memo) const;

 private:
  void add(const Material& material);
  void add(const Heightmap& map);
  const Texture* load(const std::string& path);
  Color ground(const Heightmap& map, const raycast::SurfaceInteraction& point, double footprint_m,
               LookupCache& memo) const;

  Log log_;
  std::map<const Model*, std::shared_ptr<const Model>> models_;  // owns the keys below
  std::map<std::string, std::unique_ptr<Texture>> textures_;
  std::unordered_map<const Material*, const Texture*> of_material_;
  std::unordered_map<const Heightmap*, std::vector<const Texture*>> of_ground_;
};

}  // namespace ardee::render
