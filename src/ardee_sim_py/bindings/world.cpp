// SPDX-License-Identifier: MIT
#include "world.h"

#include <fstream>
#include <functional>
#include <iterator>
#include <utility>

#include "ardee_sim/core/state_archive.h"

namespace ardee::python {
namespace {

ResourceLocator make_locator(const LoadedWorld::Folders& folders) {
  ResourceLocator locator = ResourceLocator::from_environment(folders.packages);
  locator.add_first_model_paths(folders.models);
  for (const std::string& folder : folders.media) locator.add_resource_path(folder);
  return locator;
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error({path, 0, ""}, "found no file that can be read");
  return text;
}

void write(StateArchive& archive, Instance instance) {
  std::string model = instance.model->name;
  archive(instance.name, model, instance.pose, instance.scale, instance.label);
  for (const Instance& each : instance.model->instances) write(archive, each);
}

std::size_t fingerprint_of(std::string text, const World& world) {
  StateArchive archive;
  archive(text);
  for (const Instance& each : world.models) write(archive, each);
  return std::hash<std::string>{}(archive.bytes());
}

}  // namespace

std::shared_ptr<LoadedWorld> LoadedWorld::from_file(const std::string& name,
                                                    const Folders& folders) {
  const std::string path = make_locator(folders).find_world(name);
  return std::make_shared<LoadedWorld>(read_text(path), path, folders);
}

LoadedWorld::LoadedWorld(std::string text, const std::string& path, const Folders& folders)
    : text_(std::move(text)),
      path_(path),
      locator_(make_locator(folders)),
      said_(std::make_shared<std::vector<LogLine>>()),
      loader_(locator_, Log([said = said_](LogLevel level, const std::string& line) {
                said->push_back({level, line});
              })),
      world_(std::make_shared<const World>(loader_.load_world_text(text_, path))),
      world_log_(std::exchange(*said_, {})),
      fingerprint_(fingerprint_of(text_, *world_)) {}

std::shared_ptr<const LoadedModel> LoadedWorld::load_model(const std::string& text,
                                                           const std::string& name) {
  const std::lock_guard<std::mutex> lock(reading_);
  said_->clear();  // of a model that was refused
  auto model = loader_.load_model_text(text, name);
  return std::make_shared<const LoadedModel>(
      LoadedModel{std::move(model), text, name, std::exchange(*said_, {})});
}

}  // namespace ardee::python
