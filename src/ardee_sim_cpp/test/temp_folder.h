// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace ardee {

/// Folder of one test, removed afterwards.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "ardee_test_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = std::filesystem::path(path_) / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  /// Writes a model folder in Gazebo's layout: model.config and model.sdf with `body` inside <model
  /// name="NAME">.
  void write_model(const std::string& name, const std::string& body,
                   const std::string& version = "1.5") const {
    write(name + "/model.config", "<model><sdf version='" + version + "'>model.sdf</sdf></model>");
    write(name + "/model.sdf",
          "<sdf version='" + version + "'><model name='" + name + "'>" + body + "</model></sdf>");
  }

 private:
  std::string path_;
};

}  // namespace ardee
