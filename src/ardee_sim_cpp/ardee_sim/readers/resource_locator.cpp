// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/resource_locator.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>

#include "ardee_sim/core/nearest_names.h"
#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/fuel_cache.h"
#include "ardee_sim/readers/package_index.h"
#include "ardee_sim/readers/sdf_version.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {
namespace fs = std::filesystem;
namespace {

std::vector<std::string> environment_list(const char* name) {
  const char* value = std::getenv(name);
  return value ? split_path_list(value) : std::vector<std::string>{};
}

std::string normal(const fs::path& path) { return path.lexically_normal().string(); }

bool is_there(const fs::path& place) {
  std::error_code error;
  return fs::exists(place, error);
}

/// The exports of packages are used only if nothing else is found, as they require a search of
/// their folders.
void add_exports(const ResourceLocator::PathExports& exports, const std::string& rest,
                 std::vector<fs::path>& places) {
  if (!exports || std::any_of(places.begin(), places.end(), is_there)) return;
  for (const std::string& folder : exports()) places.push_back(fs::path(folder) / rest);
}

/// Calls `use(path)` for each file and folder in a folder; none if it cannot be read.
template <typename Use>
void each_in(const fs::path& folder, Use use) {
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    use(it->path());
  }
}

bool is_model(const fs::path& folder) {
  return is_there(folder / "model.config") || is_there(folder / "model.sdf");
}

bool is_world(const fs::path& file) {
  return file.extension() == ".world" || file.extension() == ".sdf";
}

/// The names nearest to one that is in none of the places, for a message; empty if there are none:
/// of models for a model:// URI whose model is not there, else of files with the same ending.
std::string nearest_beside(const std::vector<fs::path>& places, const std::string& uri) {
  const std::size_t mark = uri.find("://");
  const fs::path rest = mark == std::string::npos ? uri : uri.substr(mark + 3);
  const std::string name = rest.filename().string();
  std::set<std::string> models;
  std::set<std::string> files;
  for (const fs::path& place : places) {
    each_in(place.parent_path(), [&](const fs::path& path) {
      if (rest.has_extension() && path.extension() == rest.extension()) {
        files.insert(path.filename().string());
      }
    });
    fs::path folder = place;
    for (auto part = rest.begin(); part != rest.end(); ++part) folder = folder.parent_path();
    each_in(folder, [&](const fs::path& path) {
      if (is_model(path)) models.insert(path.filename().string());
    });
  }
  const std::string model = rest.begin()->string();
  if (uri.rfind("model://", 0) == 0 && models.count(model) == 0) {
    return models.empty() ? ""
                          : "; nearest: " + nearest_names(model, {models.begin(), models.end()});
  }
  return files.empty() ? "" : "; nearest: " + nearest_names(name, {files.begin(), files.end()});
}

/// Name of a file for messages: a relative path gets the folder of the referring file.
std::string name_of(const std::string& uri, const Source& source) {
  return uri.find("://") == std::string::npos ? folder_of(source.file) + "/" + uri : uri;
}

/// The first of `places` that exists, or a FileError that lists them.
std::string first_existing(const std::vector<fs::path>& places, const std::string& uri,
                           const Source& source) {
  std::string searched;
  std::set<std::string> named;  // a folder may be on several paths
  for (const fs::path& place : places) {
    if (is_there(place)) return normal(place);
    std::error_code error;
    const std::string whole = normal(fs::absolute(place, error));
    if (named.insert(whole).second) searched += (searched.empty() ? "" : ", ") + whole;
  }
  throw FileError(source, name_of(uri, source),
                  "found '" + uri + "', expected an existing file; searched: " +
                      (searched.empty() ? "nowhere (no path is set)" : searched) +
                      nearest_beside(places, uri));
}

/// The file that a model.config gives for the newest version of Gazebo Classic, for whose plugins
/// it is made; else its last.
std::string choose_sdf(const Node& config) {
  std::optional<Node> best;
  std::optional<Node> last;
  int best_version = 0;
  config.each("sdf", [&](const Node& candidate) {
    last = candidate;
    const int version = parse_sdf_version(candidate.attribute("version")).value_or(0);
    if (version > kNewestClassicSdf || (best && version <= best_version)) return;
    best = candidate;
    best_version = version;
  });
  if (!last) throw config.error("found no <sdf>, expected one with the name of the model's file");
  return (best ? *best : *last).required_text();
}

}  // namespace

ResourceLocator ResourceLocator::from_environment(std::vector<std::string> package_folders) {
  ResourceLocator locator;
  locator.model_paths_ = environment_list("GAZEBO_MODEL_PATH");
  // Gazebo's default folder of downloaded models.
  if (const char* home = std::getenv("HOME")) {
    std::error_code error;
    const std::string kept = normal(fs::path(home) / ".gazebo" / "models");
    if (fs::is_directory(kept, error)) locator.model_paths_.push_back(kept);
    for (const char* tools : {".gz", ".ignition"}) {
      locator.fuel_caches_.push_back(normal(fs::path(home) / tools / "fuel"));
    }
  }
  locator.resource_paths_ = environment_list("GAZEBO_RESOURCE_PATH");
  for (std::string& folder : environment_list("ROS_PACKAGE_PATH")) {
    package_folders.push_back(std::move(folder));
  }
  auto index = std::make_shared<PackageIndex>(package_folders);
  locator.find_package_ = [index](const std::string& package) { return index->find(package); };
  locator.model_exports_ = [index] { return index->exported_model_paths(); };
  locator.media_exports_ = [index] { return index->exported_media_paths(); };
  return locator;
}

std::string ResourceLocator::resolve(const std::string& uri, const Source& source) const {
  const std::size_t mark = uri.find("://");
  const std::string scheme = mark == std::string::npos ? "" : uri.substr(0, mark);
  const std::string rest = mark == std::string::npos ? uri : uri.substr(mark + 3);
  if (rest.empty()) throw Error(source, "found an empty path '" + uri + "', expected a file's");
  if (scheme == "package") return resolve_package(uri, rest, source);
  if (scheme == "https" || scheme == "http") return resolve_fuel(uri, rest, source);
  std::vector<fs::path> places;
  if (scheme == "model") {
    for (const std::string& folder : model_paths_) places.push_back(fs::path(folder) / rest);
    add_exports(model_exports_, rest, places);
  } else if (fs::path(rest).is_absolute() && (scheme.empty() || scheme == "file")) {
    places.push_back(rest);
  } else if (scheme == "file") {
    places = file_places(rest, source);
  } else if (scheme.empty()) {
    places.push_back(fs::path(folder_of(source.file)) / rest);
  } else {
    throw FileError(source, uri,
                    "found '" + uri + "', expected model://, package://, file:// or a path");
  }
  return first_existing(places, uri, source);
}

std::vector<fs::path> ResourceLocator::file_places(const std::string& rest,
                                                   const Source& source) const {
  std::vector<fs::path> places;
  for (const auto* folders : {&resource_paths_, &model_paths_}) {
    for (const std::string& folder : *folders) places.push_back(fs::path(folder) / rest);
  }
  for (const auto* folders : {&resource_paths_, &model_paths_}) {
    for (const std::string& folder : *folders) {
      places.push_back(fs::path(normal(folder + "/..")) / rest);
    }
  }
  places.push_back(fs::path(folder_of(source.file)) / rest);
  add_exports(media_exports_, rest, places);
  return places;
}

std::string ResourceLocator::find_world(const std::string& world) const {
  if (world.find("://") != std::string::npos) return resolve(world, Source{});
  const fs::path path(world);
  std::vector<fs::path> places{path};
  if (path.is_relative()) {
    for (const fs::path& place : file_places(world, Source{})) places.push_back(place);
  }
  std::set<std::string> names;  // as they may be given
  for (const fs::path& place : places) {
    if (is_there(place)) return place == path ? world : normal(place);
    const fs::path given = path.is_relative() ? path.parent_path() : fs::path();
    for (const char* below : {"", "worlds"}) {
      each_in(fs::absolute(place).parent_path() / below, [&](const fs::path& file) {
        if (is_world(file)) names.insert((given / below / file.filename()).string());
      });
    }
  }
  const std::string nearest =
      names.empty()
          ? ""
          : "; nearest: " + nearest_names(path.is_relative() ? world : path.filename().string(),
                                          {names.begin(), names.end()});
  if (path.is_absolute())
    throw Error("found no file " + world + ", expected a world file" + nearest);
  throw Error("found no world '" + world +
              "', expected a file, here or below a folder of GAZEBO_RESOURCE_PATH" + nearest);
}

std::string ResourceLocator::resolve_package(const std::string& uri, const std::string& rest,
                                             const Source& source) const {
  const std::size_t slash = std::min(rest.find('/'), rest.size());
  const std::string package = rest.substr(0, slash);
  const auto folder = find_package_ ? find_package_(package) : std::nullopt;
  if (!folder) {
    throw FileError(source, uri,
                    "found '" + uri + "', expected a known package; searched for package '" +
                        package + "' on ROS_PACKAGE_PATH and in /usr/share");
  }
  const std::string inside = slash < rest.size() ? rest.substr(slash + 1) : "";
  return first_existing({fs::path(*folder) / inside}, uri, source);
}

std::string ResourceLocator::resolve_fuel(const std::string& uri, const std::string& rest,
                                          const Source& source) const {
  std::string caches;
  for (const std::string& cache : fuel_caches_) {
    for (const fs::path& place : places_in_fuel_cache(cache, rest)) {
      if (is_there(place)) return normal(place);
    }
    caches += (caches.empty() ? "" : " and ") + cache;
  }
  throw FileError(source, uri,
                  "found '" + uri + "', expected what was downloaded before, as nothing is now" +
                      (caches.empty() ? "" : "; searched: " + caches));
}

std::string ResourceLocator::resolve_model(const std::string& uri, const Source& source) const {
  std::string place = resolve(uri, source);
  std::error_code error;
  if (!fs::is_directory(place, error)) return place;
  const fs::path folder(place);
  const fs::path config = folder / "model.config";
  if (fs::is_regular_file(config, error)) {
    const XmlFile document(read_text_file(config.string(), source, std::size_t{1} << 20),
                           config.string());
    return first_existing({folder / choose_sdf(document.root())}, uri, document.root().source());
  }
  return first_existing({folder / "model.sdf"}, uri, source);
}

}  // namespace ardee
