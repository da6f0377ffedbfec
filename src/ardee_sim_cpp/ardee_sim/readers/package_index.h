// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ardee {

/// Folders of the packages of ROS_PACKAGE_PATH, found by their package.xml as rospack does. The
/// folders are searched once, at the first look-up.
class PackageIndex {
 public:
  explicit PackageIndex(std::vector<std::string> roots) : roots_(std::move(roots)) {}

  std::optional<std::string> find(const std::string& package);
  /// Entries that packages add to Gazebo's paths by <export><gazebo_ros gazebo_model_path="..."
  /// gazebo_media_path="..."/>.
  const std::vector<std::string>& exported_model_paths();
  const std::vector<std::string>& exported_media_paths();

 private:
  void walk_once();
  void walk(const std::string& folder, int depth);

  std::vector<std::string> roots_;
  bool walked_ = false;
  std::map<std::string, std::string> folders_;
  std::vector<std::string> exported_model_paths_;
  std::vector<std::string> exported_media_paths_;
};

/// The parts of a colon-separated list, empty ones left out.
std::vector<std::string> split_path_list(const std::string& list);

}  // namespace ardee
