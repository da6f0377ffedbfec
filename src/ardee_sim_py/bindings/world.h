// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ardee_sim/readers/loader.h"

namespace ardee::python {

/// Message of the engine.
struct LogLine {
  LogLevel level;
  std::string text;
};

/// A model as read from a text, which a snapshot keeps.
struct LoadedModel {
  std::shared_ptr<const Model> model;
  std::string text;
  std::string name;          // of its file, for messages
  std::vector<LogLine> log;  // of reading it
};

/// A world, and the reader that made it: models spawned in its simulations share the files that it
/// has read.
class LoadedWorld {
 public:
  /// Folders to search before those of the environment.
  struct Folders {
    std::vector<std::string> models;
    std::vector<std::string> media;
    std::vector<std::string> packages;  // of ROS
  };

  /// Reads a file, by its path or its name below the resource paths.
  static std::shared_ptr<LoadedWorld> from_file(const std::string& name, const Folders& folders);
  /// Reads a text; `path` is its file's, or a name for messages.
  LoadedWorld(std::string text, const std::string& path, const Folders& folders);

  const std::shared_ptr<const World>& world() const { return world_; }
  const ResourceLocator& locator() const { return locator_; }
  const std::string& text() const { return text_; }
  const std::string& path() const { return path_; }
  /// Tells worlds apart: by the text, and by where which models stand, as included files say.
  std::size_t fingerprint() const { return fingerprint_; }
  /// Messages of reading the world.
  const std::vector<LogLine>& log() const { return world_log_; }
  std::shared_ptr<const LoadedModel> load_model(const std::string& text, const std::string& name);

 private:
  std::string text_;
  std::string path_;
  ResourceLocator locator_;
  std::shared_ptr<std::vector<LogLine>> said_;  // by the loader, since the last take
  std::mutex reading_;
  Loader loader_;
  std::shared_ptr<const World> world_;
  std::vector<LogLine> world_log_;
  std::size_t fingerprint_;
};

}  // namespace ardee::python
