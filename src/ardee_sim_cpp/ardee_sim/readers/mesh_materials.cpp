// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_materials.h"

#include <algorithm>
#include <filesystem>

namespace ardee {
namespace fs = std::filesystem;
namespace {

Color color_of(const aiMaterial& source, const char* key, unsigned type, unsigned index,
               const Color& fallback) {
  aiColor4D value;
  if (source.Get(key, type, index, value) != AI_SUCCESS) return fallback;
  const Color color(value.r, value.g, value.b, value.a);
  return color.allFinite() ? Color(color.cwiseMax(0.0f).cwiseMin(1.0f)) : fallback;
}

std::string texture_beside(const std::string& written, const std::string& mesh_path) {
  std::string name = written.rfind("file://", 0) == 0 ? written.substr(7) : written;
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path folder = fs::path(mesh_path).parent_path();
  const fs::path bare = fs::path(name).filename();
  for (const fs::path& place :
       {folder / name, folder / bare, folder / "../materials/textures" / bare}) {
    std::error_code error;
    if (fs::is_regular_file(place, error)) return place.lexically_normal().string();
  }
  return "";
}

}  // namespace

Material read_mesh_material(const aiMaterial& source, const std::string& mesh_path) {
  Material material;
  aiString text;
  if (source.Get(AI_MATKEY_NAME, text) == AI_SUCCESS) material.name = text.C_Str();
  material.diffuse = color_of(source, AI_MATKEY_COLOR_DIFFUSE, material.diffuse);
  material.ambient = color_of(source, AI_MATKEY_COLOR_AMBIENT, material.diffuse);
  material.specular = color_of(source, AI_MATKEY_COLOR_SPECULAR, material.specular);
  material.emissive = color_of(source, AI_MATKEY_COLOR_EMISSIVE, material.emissive);
  float opacity = 1.0f;
  if (source.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS && opacity >= 0.0f && opacity < 1.0f) {
    material.diffuse[3] = opacity;
  }
  int two_sided = 0;
  if (source.Get(AI_MATKEY_TWOSIDED, two_sided) == AI_SUCCESS) material.two_sided = two_sided != 0;
  constexpr char kInsideTheFile = '*';
  if (source.GetTexture(aiTextureType_DIFFUSE, 0, &text) == AI_SUCCESS &&
      text.C_Str()[0] != kInsideTheFile) {
    material.texture_path = texture_beside(text.C_Str(), mesh_path);
    // The picture gives the colour: assimp's default for an absent colour would darken it.
    material.diffuse.head<3>().setOnes();
    material.ambient.head<3>().setOnes();
  }
  return material;
}

}  // namespace ardee
