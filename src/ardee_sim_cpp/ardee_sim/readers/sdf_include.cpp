// SPDX-License-Identifier: MIT
#include <algorithm>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/sdf_parts.h"
#include "ardee_sim/readers/sdf_reader.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxIncludeDepth = 32;

const char* static_key(std::optional<bool> make_static) {
  if (!make_static) return "as written\n";
  return *make_static ? "static\n" : "moving\n";
}

}  // namespace

/// Marks a file as being read, for as long as this lives.
class SdfReader::Reading {
 public:
  Reading(std::vector<std::string>& files, const std::string& path) : files_(files) {
    files_.push_back(path);
  }
  ~Reading() { files_.pop_back(); }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

 private:
  std::vector<std::string>& files_;
};

const SdfReader::ModelFile& SdfReader::included_file(const Node& include,
                                                     std::optional<bool> make_static) {
  if (!make_static) {
    if (const auto own = include.child("static")) make_static = own->to_boolean();
  }
  const auto uri = include.child("uri");
  if (!uri) throw include.error("found no <uri>, expected one");
  return included_file(uri->required_text(), uri->source(), make_static);
}

const SdfReader::ModelFile& SdfReader::included_file(const std::string& uri, const Source& source,
                                                     std::optional<bool> make_static) {
  std::string key = static_key(make_static);
  if (uri.find("://") == std::string::npos) key += folder_of(source.file) + '\n';
  key += uri;
  const auto known = by_uri_.find(key);
  if (known != by_uri_.end()) return *known->second;
  const ModelFile* file = nullptr;
  const auto read = [&] {
    const std::string path = assets_.locator().resolve_model(uri, source);
    try {
      file = &read_file(path, source, make_static);
    } catch (const Error& problem) {
      throw FileError(problem, path);
    }
  };
  if (!assets_.has_files(read)) {
    static const ModelFile kLeftOut;
    return kLeftOut;
  }
  by_uri_[key] = file;
  return *file;
}

const SdfReader::ModelFile& SdfReader::read_file(const std::string& path, const Source& source,
                                                 std::optional<bool> make_static) {
  const std::string key = static_key(make_static) + path;
  const auto known = files_.find(key);
  if (known != files_.end()) return known->second;
  if (std::find(reading_.begin(), reading_.end(), path) != reading_.end()) {
    std::string chain;
    for (const std::string& file : reading_) chain += file + " -> ";
    throw Error(source, "found an include cycle " + chain + path + ", expected none");
  }
  if (reading_.size() >= kMaxIncludeDepth) {
    throw Error(source, "found includes nested more than " + std::to_string(kMaxIncludeDepth) +
                            " deep, expected fewer");
  }
  const Reading mark(reading_, path);
  const XmlFile document(read_text_file(path, source, kMaxXmlBytes), path);
  const Node root = document.root();
  if (root.name() != "sdf" && root.name() != "gazebo") {
    throw root.error("found this root element, expected <sdf>");
  }
  ModelFile file;
  const Scope scope{read_version(root), make_static};
  sdf_schema().check(root, assets_.log());
  if (const auto model = root.child("model")) file.model = read_own_model(*model, scope);
  root.each("light", [&file](const Node& light) {
    file.lights.push_back(read_sdf_light(light, light.pose()));
  });
  if (!file.model && file.lights.empty()) {
    throw root.error("found no <model> and no <light>, expected one");
  }
  return files_[key] = std::move(file);
}

/// Adds the model to the frames last, so that it is absent after a throw.
Instance SdfReader::read_include(const Node& include, const ModelFile& file,
                                 const std::string& name, SdfFrames& frames) {
  Instance made;
  made.model = file.model;
  made.name = name;
  std::optional<Pose> X_MP = file.model->X_MP;
  if (const auto placed = include.child("placement_frame"); placed && !placed->text().empty()) {
    const auto frame = file.model->find_frame(placed->text());
    if (!frame)
      throw placed->error("found frame '" + placed->text() + "', expected one of the model");
    X_MP = frame->X_MF;
  }
  made.is_static = file.model->is_static;
  if (const auto scale = include.child("ardee:scale")) {
    made.scale = scale->to_number(0.0, kMaxScale);
    if (!(made.scale > 0.0)) {
      throw scale->error("found '" + scale->text() + "', expected a positive number");
    }
    if (!made.is_static) throw scale->error("found a scale, expected it on static models only");
  }
  if (const auto label = include.child("ardee:label")) {
    made.label = static_cast<std::uint32_t>(label->to_integer(1, kMaxLabel));
  }
  if (include.child("plugin")) {
    auto with_plugins = std::make_shared<Model>(*file.model);
    include.each("plugin", [&with_plugins](const Node& plugin) {
      with_plugins->plugins.push_back(read_plugin(plugin));
    });
    placements_[with_plugins.get()] = placements_.at(file.model.get());
    made.model = with_plugins;
  }
  if (include.child("pose") || include.child("placement_frame")) {
    frames.add_model(name, include, X_MP, file.model);
  } else {
    frames.add_model(name, file.model->own_pose, file.model);
  }
  return made;
}

}  // namespace ardee
