// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/error.h"

namespace ardee {

/// Thrown for a file that is missing or cannot be read in its format.
class FileError : public Error {
 public:
  FileError(const Source& source, const std::string& file, const std::string& what)
      : Error(source, what), file_(file) {}
  FileError(const Error& problem, const std::string& file) : Error(problem), file_(file) {}

  /// Path or URI of the file.
  const std::string& file() const { return file_; }

 private:
  std::string file_;
};

/// Finds the file that a URI names: model://, package://, file://, an absolute path, a path beside
/// the referring file, or https:// for a downloaded model of Fuel.
class ResourceLocator {
 public:
  using PackageFinder = std::function<std::optional<std::string>(const std::string& package)>;

  using PathExports = std::function<std::vector<std::string>()>;

  /// GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH and ROS_PACKAGE_PATH of the environment, and before
  /// the last these folders with packages.
  static ResourceLocator from_environment(std::vector<std::string> package_folders = {});

  void add_model_path(const std::string& folder) { model_paths_.push_back(folder); }
  /// Folders of models to search before all others, the first of them first.
  void add_first_model_paths(const std::vector<std::string>& folders) {
    model_paths_.insert(model_paths_.begin(), folders.begin(), folders.end());
  }
  void add_resource_path(const std::string& folder) { resource_paths_.push_back(folder); }
  /// A folder with models that Gazebo's tools downloaded from Fuel.
  void add_fuel_cache(const std::string& folder) { fuel_caches_.push_back(folder); }
  void set_package_finder(PackageFinder finder) { find_package_ = std::move(finder); }

  /// Further model folders; used only if a model is in none of the others.
  void set_model_path_exports(PathExports exports) { model_exports_ = std::move(exports); }
  /// Further folders for file://; likewise.
  void set_media_path_exports(PathExports exports) { media_exports_ = std::move(exports); }

  /// The existing file or folder that `uri` names. Throws FileError at `source` with the
  /// places searched.
  std::string resolve(const std::string& uri, const Source& source) const;
  /// The .sdf file of the model folder that `uri` names (model.config's <sdf>, highest version up
  /// to 1.6 first).
  std::string resolve_model(const std::string& uri, const Source& source) const;
  /// A world file by its path, or by its name below the resource paths. Throws Error with the
  /// names of the nearest worlds.
  std::string find_world(const std::string& world) const;

 private:
  /// Places in which the path of a file:// URI is searched for, in this order.
  std::vector<std::filesystem::path> file_places(const std::string& path,
                                                 const Source& source) const;
  std::string resolve_package(const std::string& uri, const std::string& rest,
                              const Source& source) const;
  std::string resolve_fuel(const std::string& uri, const std::string& rest,
                           const Source& source) const;

  std::vector<std::string> model_paths_;
  std::vector<std::string> resource_paths_;
  std::vector<std::string> fuel_caches_;
  PackageFinder find_package_;
  PathExports model_exports_;
  PathExports media_exports_;
};

}  // namespace ardee
