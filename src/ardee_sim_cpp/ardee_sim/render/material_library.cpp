// SPDX-License-Identifier: MIT
#include "ardee_sim/render/material_library.h"

#include <algorithm>

namespace ardee::render {
namespace {

/// Colour of dry loam, for ground without textures.
const Color kBareSoil(0.45f, 0.36f, 0.27f, 1.0f);

}  // namespace

const Texture* MaterialLibrary::load(const std::string& path) {
  if (path.empty()) return nullptr;
  const auto [entry, is_new] = textures_.try_emplace(path, nullptr);
  if (is_new) {
    try {
      entry->second = std::make_unique<Texture>(read_color_image(path, {path, 0, ""}));
    } catch (const Error& error) {
      log_.warn_once(std::string(error.what()) + "; the picture goes without it");
    }
  }
  return entry->second.get();
}

void MaterialLibrary::add(const Material& material) {
  const Texture* texture = load(material.texture_path);
  if (texture != nullptr) of_material_[&material] = texture;
}

void MaterialLibrary::add(const Heightmap& map) {
  std::vector<const Texture*> layers;
  for (const GroundTexture& layer : map.textures) layers.push_back(load(layer.diffuse_path));
  of_ground_[&map] = std::move(layers);
}

void MaterialLibrary::add(const std::shared_ptr<const Model>& model) {
  if (!models_.emplace(model.get(), model).second) return;
  for (const Link& link : model->links) {
    for (const Visual& visual : link.visuals) {
      if (visual.material) add(*visual.material);
      if (const auto* map = std::get_if<Heightmap>(&visual.geometry)) add(*map);
      const auto* mesh = std::get_if<Mesh>(&visual.geometry);
      if (mesh == nullptr || mesh->file == nullptr) continue;
      for (const Material& material : mesh->file->materials) add(material);
    }
  }
}

void MaterialLibrary::clear() {
  of_material_.clear();
  of_ground_.clear();
  models_.clear();
}

Color MaterialLibrary::ground(const Heightmap& map, const raycast::SurfaceInteraction& point,
                              double footprint_m, LookupCache& memo) const {
  if (memo.map != &map) {
    const auto found = of_ground_.find(&map);
    memo.map = &map;
    memo.layers = found == of_ground_.end() ? nullptr : &found->second;
  }
  if (memo.layers == nullptr) return kBareSoil;
  const double height_m = point.point_S.z();
  const Eigen::Vector2d place = point.point_S.head<2>();
  Color color = kBareSoil;
  for (std::size_t k = 0; k < memo.layers->size(); ++k) {
    double share = 1.0;
    if (k > 0) {
      if (k > map.blends.size()) break;
      const GroundBlend& blend = map.blends[k - 1];
      const double above_m = height_m - blend.min_height_m;
      share = blend.fade_m > 0.0 ? std::clamp(above_m / blend.fade_m, 0.0, 1.0)
                                 : (above_m >= 0.0 ? 1.0 : 0.0);
    }
    const Texture* texture = (*memo.layers)[k];
    if (texture == nullptr || share == 0.0) continue;
    const double size_m = std::max(map.textures[k].size_m, 1e-6);
    const Color layer = texture->color(place / size_m, footprint_m / size_m);
    color += static_cast<float>(share) * (layer - color);
  }
  return color;
}

SurfaceColor MaterialLibrary::at(const raycast::SurfaceInteraction& point, double footprint_m,
                                 LookupCache& memo) const {
  static const Material kPlain;
  const Heightmap* map =
      point.visual != nullptr ? std::get_if<Heightmap>(&point.visual->geometry) : nullptr;
  const bool textured_ground = map != nullptr && point.material == nullptr;
  const Material& material = point.material != nullptr ? *point.material : kPlain;
  SurfaceColor look;
  look.ambient = material.ambient.head<3>();
  look.diffuse = material.diffuse.head<3>();
  look.emissive = material.emissive.head<3>();
  look.opacity = material.diffuse[3];
  if (textured_ground || (map != nullptr && !map->textures.empty())) {
    look.ambient = look.diffuse = ground(*map, point, footprint_m, memo).head<3>();
    look.opacity = 1.0f;
  } else if (point.material != nullptr && point.uv_per_m > 0.0) {
    if (memo.material != point.material) {
      const auto found = of_material_.find(point.material);
      memo.material = point.material;
      memo.texture = found == of_material_.end() ? nullptr : found->second;
    }
    if (memo.texture != nullptr) {
      const Color color = memo.texture->color(point.uv, footprint_m * point.uv_per_m);
      look.ambient.array() *= color.head<3>().array();
      look.diffuse.array() *= color.head<3>().array();
    }
  }
  if (point.visual != nullptr) {
    look.opacity *= static_cast<float>(std::clamp(1.0 - point.visual->transparency, 0.0, 1.0));
  }
  return look;
}

}  // namespace ardee::render
