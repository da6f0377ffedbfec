// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ardee_sim/core/bad_parts.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/description/geometry.h"
#include "ardee_sim/readers/material_script.h"
#include "ardee_sim/readers/resource_locator.h"

namespace ardee {

/// The files that descriptions refer to, each read once: meshes, heightmaps, material scripts.
class Assets {
 public:
  Assets(ResourceLocator locator, Log& log, BadParts bad_parts)
      : locator_(std::move(locator)), log_(log), bad_parts_(bad_parts) {}

  /// Begins another world or model: errors of files left out are reported again.
  void begin() { left_out_.clear(); }

  /// Runs `read`, and returns whether its files exist. If one is missing and such parts are to be
  /// left out, reports it once per file; otherwise passes the FileError on.
  template <typename Read>
  bool has_files(Read read) {
    try {
      read();
      return true;
    } catch (const FileError& problem) {
      if (bad_parts_ == BadParts::kRefuse) throw;
      leave_out(problem, problem.file(), "what needs it");
      return false;
    }
  }

  /// Runs `read`, which reads an optional part of a world. If the part is malformed and such parts
  /// are to be left out, reports it once; otherwise passes the Error on. `part` names it.
  template <typename Read>
  bool is_good(const std::string& part, Read read) {
    try {
      read();
      return true;
    } catch (const Error& problem) {
      if (bad_parts_ == BadParts::kRefuse) throw;
      leave_out(problem, problem.what(), part);
      return false;
    }
  }

  const ResourceLocator& locator() const { return locator_; }
  Log& log() { return log_; }

  std::shared_ptr<const MeshFile> mesh(const std::string& uri, const Source& source);
  std::shared_ptr<const HeightGrid> heights(const std::string& uri, const Eigen::Vector3d& size_m,
                                            const Source& source);
  /// The material `name` of the scripts at `uris` (files or folders; textures are looked for there
  /// as well) or of Gazebo's own; grey with a warning if there is none.
  Material material(const std::string& name, const std::vector<std::string>& uris,
                    const Source& source);
  /// The image file of a texture's URI; empty with a warning if there is none.
  std::string texture(const std::string& uri, const Source& source);

 private:
  std::optional<std::string> try_resolve(const std::string& uri, const Source& source) const;
  /// Reports that `part` is left out, once per `key`.
  void leave_out(const Error& problem, const std::string& key, const std::string& part);
  const MaterialScript& script(const std::string& path);
  std::string find_texture(const std::string& file, const std::vector<std::string>& folders) const;

  ResourceLocator locator_;
  Log& log_;
  BadParts bad_parts_;
  std::set<std::string> left_out_;  // files and problems that were reported
  std::map<std::string, std::shared_ptr<const MeshFile>> meshes_;
  std::map<std::string, std::shared_ptr<const HeightGrid>> heights_;
  std::map<std::string, MaterialScript> scripts_;
};

}  // namespace ardee
