// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/assets.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/heightmap_reader.h"
#include "ardee_sim/readers/mesh_reader.h"

namespace ardee {
namespace fs = std::filesystem;
namespace {

/// The script files at a path: the file itself, or the *.material files of a folder in alphabetical
/// order.
std::vector<std::string> script_files(const std::string& place) {
  std::error_code error;
  if (!fs::is_directory(place, error)) {
    return fs::path(place).extension() == ".material" ? std::vector<std::string>{place}
                                                      : std::vector<std::string>{};
  }
  std::vector<std::string> files;
  for (fs::directory_iterator it(place, error), end; !error && it != end; it.increment(error)) {
    if (it->path().extension() == ".material") files.push_back(it->path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

void Assets::leave_out(const Error& problem, const std::string& key, const std::string& part) {
  if (!left_out_.insert(key).second) return;
  log_.error(std::string(problem.what()) + "; " + part + " is left out");
}

std::shared_ptr<const MeshFile> Assets::mesh(const std::string& uri, const Source& source) {
  const std::string path = locator_.resolve(uri, source);
  const auto found = meshes_.find(path);
  if (found != meshes_.end()) return found->second;
  try {
    return meshes_[path] = std::make_shared<const MeshFile>(read_mesh_file(path, source, log_));
  } catch (const Error& problem) {
    throw FileError(problem, uri);
  }
}

std::shared_ptr<const HeightGrid> Assets::heights(const std::string& uri,
                                                  const Eigen::Vector3d& size_m,
                                                  const Source& source) {
  const std::string path = locator_.resolve(uri, source);
  std::ostringstream key;
  key.precision(17);
  key << size_m.transpose() << ' ' << path;
  const auto found = heights_.find(key.str());
  if (found != heights_.end()) return found->second;
  try {
    return heights_[key.str()] =
               std::make_shared<const HeightGrid>(read_height_grid(path, size_m, source, log_));
  } catch (const Error& problem) {
    throw FileError(problem, uri);
  }
}

std::optional<std::string> Assets::try_resolve(const std::string& uri, const Source& source) const {
  try {
    return locator_.resolve(uri, source);
  } catch (const Error&) {
    return std::nullopt;
  }
}

const MaterialScript& Assets::script(const std::string& path) {
  constexpr std::size_t kMaxBytes = std::size_t{1} << 24;
  const auto found = scripts_.find(path);
  if (found != scripts_.end()) return found->second;
  MaterialScript read;
  try {
    read = parse_material_script(read_text_file(path, Source{path, 0, ""}, kMaxBytes), path, log_);
  } catch (const Error& problem) {
    log_.warn(std::string(problem.what()) + "; the script is left out");
  }
  return scripts_[path] = std::move(read);
}

std::string Assets::find_texture(const std::string& file,
                                 const std::vector<std::string>& folders) const {
  for (const std::string& folder : folders) {
    const fs::path place = fs::path(folder) / file;
    std::error_code error;
    if (fs::is_regular_file(place, error)) return place.lexically_normal().string();
  }
  return try_resolve("file://media/materials/textures/" + file, Source{}).value_or("");
}

Material Assets::material(const std::string& name, const std::vector<std::string>& uris,
                          const Source& source) {
  std::vector<std::string> folders;
  std::optional<Material> made;
  std::string missing;
  for (const std::string& uri : uris) {
    const auto place = try_resolve(uri, source);
    if (!place) {
      missing += (missing.empty() ? "" : ", ") + uri;
      continue;
    }
    std::error_code error;
    const std::string folder = fs::is_directory(*place, error) ? *place : folder_of(*place);
    folders.push_back(folder);
    folders.push_back(folder + "/../textures");
    for (const std::string& file : script_files(*place)) {
      const MaterialScript& materials = script(file);
      const auto found = materials.find(name);
      if (!made && found != materials.end()) made = found->second;
    }
  }
  if (!made) {
    const auto own = gazebo_materials().find(name);
    if (own != gazebo_materials().end()) return own->second;
    log_.warn_once(source.to_string() + ": found no material '" + name + "'" +
                   (missing.empty() ? "" : " (and nothing at " + missing + ")") + ", grey is used");
    Material grey;
    grey.name = name;
    return grey;
  }
  if (!made->texture_path.empty()) {
    const std::string file = made->texture_path;
    made->texture_path = find_texture(file, folders);
    if (made->texture_path.empty()) {
      log_.warn_once(source.to_string() + ": found no texture '" + file + "' of material '" + name +
                     "', its colours are used");
    }
  }
  return *made;
}

std::string Assets::texture(const std::string& uri, const Source& source) {
  const auto place = try_resolve(uri, source);
  std::error_code error;
  if (place && fs::is_regular_file(*place, error)) return *place;
  log_.warn_once(source.to_string() + ": found no texture '" + uri + "', none is used");
  return "";
}

}  // namespace ardee
