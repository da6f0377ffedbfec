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

/// What a surface does with light at a point: shares of red, green and blue; its own light.
struct SurfaceColor {
  Eigen::Vector3f ambient{0, 0, 0};
  Eigen::Vector3f diffuse{0, 0, 0};
  Eigen::Vector3f emissive{0, 0, 0};
  float opacity = 1.0f;
};

/// The materials of models, their textures loaded once. Reading is safe from many threads.
class MaterialLibrary {
 public:
  explicit MaterialLibrary(Log log) : log_(std::move(log)) {}

  /// Loads the textures of the model's visuals. One that cannot be read is a warning, and white.
  void add(const std::shared_ptr<const Model>& model);

  /// Forgets all models, but keeps textures for those that come back.
  void clear();

  /// What was found last: neighbours in a picture are mostly of one surface.
  struct LookupCache {
    const Material* material = nullptr;
    const Texture* texture = nullptr;
    const Heightmap* map = nullptr;
    const std::vector<const Texture*>* layers = nullptr;
  };

  /// The colour of a point, seen so that a pixel covers `footprint_m` of it.
  SurfaceColor at(const raycast::SurfaceInteraction& point, double footprint_m,
                  LookupCache& memo) const;

 private:
  void add(const Material& material);
  void add(const Heightmap& map);
  const Texture* load(const std::string& path);
  Color ground(const Heightmap& map, const raycast::SurfaceInteraction& point, double footprint_m,
               LookupCache& memo) const;

  Log log_;
  std::map<const Model*, std::shared_ptr<const Model>> models_;  // held: keys below point into them
  std::map<std::string, std::unique_ptr<Texture>> textures_;
  std::unordered_map<const Material*, const Texture*> of_material_;
  std::unordered_map<const Heightmap*, std::vector<const Texture*>> of_ground_;
};

}  // namespace ardee::render
