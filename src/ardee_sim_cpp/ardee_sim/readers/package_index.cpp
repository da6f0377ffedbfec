// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/package_index.h"

#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace ardee {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxFolders = 12;

/// The name in a package.xml; that of its folder if the file is broken, as in rospack.
std::string package_name(const tinyxml2::XMLElement* root, const std::string& folder) {
  const auto* name = root ? root->FirstChildElement("name") : nullptr;
  if (name && name->GetText()) {
    std::istringstream text(name->GetText());
    std::string trimmed;
    if (text >> trimmed) return trimmed;
  }
  return fs::path(folder).filename().string();
}

/// The text with the package's folder for each "${prefix}".
std::string expand_prefix(std::string text, const std::string& folder) {
  const std::string prefix = "${prefix}";
  for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos; at += folder.size()) {
    text.replace(at, prefix.size(), folder);
  }
  return text;
}

/// Appends the folders that an attribute names in a manifest's <gazebo_ros> exports, of which there
/// may be several.
void add_exports(const tinyxml2::XMLElement* root, const std::string& folder, const char* attribute,
                 std::vector<std::string>& all) {
  const auto* exports = root ? root->FirstChildElement("export") : nullptr;
  const auto* gazebo = exports ? exports->FirstChildElement("gazebo_ros") : nullptr;
  for (; gazebo; gazebo = gazebo->NextSiblingElement("gazebo_ros")) {
    const char* list = gazebo->Attribute(attribute);
    if (!list) continue;
    for (std::string& path : split_path_list(expand_prefix(list, folder))) {
      all.push_back(std::move(path));
    }
  }
}

}  // namespace

std::vector<std::string> split_path_list(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, ':');) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

void PackageIndex::walk(const std::string& folder, int depth) {
  std::error_code error;
  const fs::path manifest = fs::path(folder) / "package.xml";
  if (fs::is_regular_file(manifest, error)) {
    tinyxml2::XMLDocument document;
    document.LoadFile(manifest.c_str());
    const tinyxml2::XMLElement* root = document.RootElement();
    if (!folders_.emplace(package_name(root, folder), folder).second) return;  // the first wins
    add_exports(root, folder, "gazebo_model_path", exported_model_paths_);
    add_exports(root, folder, "gazebo_media_path", exported_media_paths_);
    return;
  }
  if (depth >= kMaxFolders || fs::exists(fs::path(folder) / "CATKIN_IGNORE", error)) return;
  std::vector<std::string> below;
  for (fs::directory_iterator it(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (it->path().filename().string().front() != '.' && it->is_directory(ignored)) {
      below.push_back(it->path().string());
    }
  }
  std::sort(below.begin(), below.end());
  for (const std::string& child : below) walk(child, depth + 1);
}

void PackageIndex::walk_once() {
  if (walked_) return;
  for (const std::string& root : roots_) walk(root, 0);
  walked_ = true;
}

const std::vector<std::string>& PackageIndex::exported_model_paths() {
  walk_once();
  return exported_model_paths_;
}

const std::vector<std::string>& PackageIndex::exported_media_paths() {
  walk_once();
  return exported_media_paths_;
}

std::optional<std::string> PackageIndex::find(const std::string& package) {
  walk_once();
  const auto found = folders_.find(package);
  if (found != folders_.end()) return found->second;
  std::error_code error;
  const fs::path system = fs::path("/usr/share") / package;
  if (!package.empty() && fs::is_directory(system, error)) return system.string();
  return std::nullopt;
}

}  // namespace ardee
