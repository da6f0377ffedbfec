// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/package_index.h"

#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace ardee {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxDepth = 12;

/// The name in a package.xml; that of its folder if the file is broken (rospack's own way out).
std::string package_name(const fs::path& manifest) {
  tinyxml2::XMLDocument document;
  if (document.LoadFile(manifest.c_str()) == tinyxml2::XML_SUCCESS && document.RootElement()) {
    const auto* name = document.RootElement()->FirstChildElement("name");
    if (name && name->GetText()) {
      std::istringstream text(name->GetText());
      std::string trimmed;
      if (text >> trimmed) return trimmed;
    }
  }
  return manifest.parent_path().filename().string();
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
    folders_.emplace(package_name(manifest), folder);  // the first of a name wins
    return;
  }
  if (depth >= kMaxDepth || fs::exists(fs::path(folder) / "CATKIN_IGNORE", error)) return;
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

std::optional<std::string> PackageIndex::find(const std::string& package) {
  if (!walked_) {
    for (const std::string& root : roots_) walk(root, 0);
    walked_ = true;
  }
  const auto found = folders_.find(package);
  if (found != folders_.end()) return found->second;
  std::error_code error;
  const fs::path system = fs::path("/usr/share") / package;
  if (!package.empty() && fs::is_directory(system, error)) return system.string();
  return std::nullopt;
}

}  // namespace ardee
