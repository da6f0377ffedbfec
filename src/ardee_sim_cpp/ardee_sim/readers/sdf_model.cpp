// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/gz_systems.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/realsense.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/sdf_parts.h"
#include "ardee_sim/readers/sdf_reader.h"
#include "ardee_sim/readers/sdf_version.h"
#include "ardee_sim/readers/validate.h"

namespace ardee {
namespace {

/// The link named by the attribute, else the first.
void choose_canonical_link(const Node& node, const SdfFrames& frames, Model& model) {
  if (model.links.empty()) return;
  const std::string named = node.attribute("canonical_link");
  model.canonical_link = named.empty() ? model.links.front().name : frames.body_of(named);
  if (model.find_link(model.canonical_link) == nullptr) {
    throw node.error(unknown_link(named, model));
  }
}

bool merges(const Node& child) {
  return child.name() == "include" &&
         parse_boolean(child.attribute("merge", "false"), child.source());
}

}  // namespace

bool is_nested(const Node& child) { return child.name() == "model" || child.name() == "include"; }

int SdfReader::read_version(const Node& root) {
  const std::string text = root.attribute("version");
  const std::string newest = sdf_version_text(kNewestSdf);
  if (text.empty()) {
    assets_.log().warn(root.source(), "found no version, read as SDF " + newest);
    return kNewestSdf;
  }
  const auto version = parse_sdf_version(text);
  if (!version) throw root.error("found version '" + text + "', expected 1.2 to " + newest);
  const int nearest = std::clamp(*version, kOldestSdf, kNewestSdf);
  if (nearest != *version) {
    assets_.log().warn(root.source(),
                       "found version " + text + ", read as SDF " + sdf_version_text(nearest));
  }
  return nearest;
}

void SdfReader::warn_of_others(const Node& parent, const Node& read) const {
  bool is_first = true;
  parent.each([&](const Node& child) {
    const auto name = child.name();
    if (name != "model" && name != "light" && name != "world" && name != "include") return;
    const bool is_read = name == read.name() && std::exchange(is_first, false);
    if (!is_read) {
      assets_.log().warn(child.source(), "found it beside the <" + std::string(read.name()) +
                                             "> that is read, expected that alone; it is left out");
    }
  });
}

std::shared_ptr<const Model> SdfReader::read_model(const Node& root) {
  const Scope scope{read_version(root), std::nullopt};
  sdf_schema().check(root, assets_.log());
  reading_.assign(1, root.file());
  // gazebo_ros's spawn scripts wrap models of the model database in a world.
  const auto world = root.child("world");
  const Node parent = world && !root.child("model") ? *world : root;
  const auto include = parent.child("include");
  std::shared_ptr<const Model> model;
  if (include && !root.child("model")) {
    warn_of_others(parent, *include);
    model = included_file(*include, std::nullopt).model;
    if (!model) throw include->error("found no model in what it names, expected one");
  } else {
    const Node own = parent.required("model");
    warn_of_others(parent, own);
    model = read_own_model(own, scope);
  }
  reading_.clear();
  return model;
}

Light SdfReader::read_light(const Node& root) {
  read_version(root);
  sdf_schema().check(root, assets_.log());
  const Node light = root.required("light");
  warn_of_others(root, light);
  return read_sdf_light(light, light.pose());
}

std::shared_ptr<const Model> SdfReader::read_own_model(const Node& node, const Scope& scope) {
  const auto made = read_model(node, scope);
  made->own_pose = place_model(node.pose(), made->X_MP);
  return made;
}

std::shared_ptr<Model> SdfReader::read_model(const Node& node, const Scope& scope) {
  auto made = std::make_shared<Model>();
  made->name = node.required_attribute("name");
  made->source = node.source();
  made->is_static = scope.make_static.value_or(node.boolean("static", false));
  made->self_collide = node.boolean("self_collide", false);
  made->allow_auto_disable = node.boolean("allow_auto_disable", true);
  SdfFrames frames("__model__");
  frames.add_children(node);
  UniqueNames names;
  const Scope nested_scope{scope.version,
                           made->is_static ? std::optional<bool>(true) : std::nullopt};
  std::vector<Placed> placed = read_placed(node, nested_scope, names, frames);
  node.each("link", [&](const Node& link) {
    made->links.push_back(read_sdf_link(link, frames, assets_));
    if (made->self_collide) made->links.back().self_collide = true;
  });
  node.each("plugin", [&](const Node& plugin) { made->plugins.push_back(read_plugin(plugin)); });
  add_nested_models(node, std::move(placed), names, frames, *made);
  choose_canonical_link(node, frames, *made);
  for (NamedFrame& frame : frames.named_frames(node)) made->frames.push_back(std::move(frame));
  if (node.has_attribute("placement_frame")) {
    made->X_MP = frames.find(node.required_attribute("placement_frame"), node);
  }
  const JointScope joint_scope(scope.version, frames, *made);
  node.each("joint", [&](const Node& joint) {
    if (joint.attribute("type") == "gearbox") return;
    made->joints.push_back(read_sdf_joint(joint, joint_scope, assets_.log()));
  });
  node.each("joint", [&](const Node& joint) {
    if (joint.attribute("type") == "gearbox") {
      read_sdf_gearbox(joint, joint_scope, assets_.log(), *made);
    }
  });
  adopt_realsense(*made, assets_.log());
  adopt_gz_systems(*made, assets_.log());
  validate_model(*made, assets_.log());
  count_placements(*made, made->source);
  return made;
}

std::vector<SdfReader::Placed> SdfReader::read_placed(const Node& parent, const Scope& scope,
                                                      UniqueNames& names, SdfFrames& frames) {
  std::vector<Placed> placed;
  parent.each([&](const Node& child) {
    if (!is_nested(child)) return;
    const bool is_merged = parent.name() == "model" && merges(child);
    Placed& made = placed.emplace_back();
    const auto read = [&] { made = placed_instance(child, scope, is_merged, names, frames); };
    if (parent.name() == "world") {
      assets_.is_good(label_of(child), read);
    } else {
      read();
    }
    if (is_merged && placed.back().instance) {
      frames.add_merged(placed.back().instance->name, *placed.back().instance->model);
    }
  });
  return placed;
}

SdfReader::Placed SdfReader::placed_instance(const Node& child, const Scope& scope, bool is_merged,
                                             UniqueNames& names, SdfFrames& frames) {
  if (child.name() == "include") {
    const ModelFile& file = included_file(child, scope.make_static);
    if (!file.model) return {std::nullopt, file.lights};
    const auto given = child.child("name");
    const std::string name = given ? given->required_text() : file.model->name;
    // A link may have the name of the merged model.
    const std::string own_name = is_merged ? "_merged__" + name + "__model__" : name;
    Instance made = read_include(child, file, names.find_free(own_name), frames);
    names.take(made.name);
    return {std::move(made), file.lights};
  }
  Instance made;
  made.model = read_model(child, scope);
  made.name = names.find_free(made.model->name);
  if (made.name != made.model->name) {
    assets_.log().warn(child.source(), "a second model of one name gets another",
                       ": '" + made.name + "'");
  }
  made.is_static = made.model->is_static;
  frames.add_model(made.name, child, made.model->X_MP, made.model);
  names.take(made.name);
  return {made, {}};
}

void SdfReader::add_nested_models(const Node& model, std::vector<Placed> placed, UniqueNames& names,
                                  const SdfFrames& frames, Model& made) {
  std::size_t bytes = bytes_of(made);
  auto next = placed.begin();
  model.each([&](const Node& child) {
    if (child.name() == "ardee:instances") read_instances(child, names, made);
    if (!is_nested(child)) return;
    auto& [nested, lights] = *next++;
    if (!nested && !lights.empty()) {
      assets_.log().warn(child.source(), "a light within a model is not supported, left out");
    }
    if (!nested) return;
    nested->pose = frames.find(nested->name, child.child("pose").value_or(child));
    if (merges(child)) {
      merge(child, *nested, "", bytes, made);
    } else {
      add_nested(child, std::move(*nested), bytes, made);
    }
  });
}

void SdfReader::add_nested(const Node& asker, Instance nested, std::size_t& bytes, Model& made) {
  if (nested.is_static) {
    made.instances.push_back(std::move(nested));
  } else {
    merge(asker, nested, nested.name, bytes, made);
  }
}

void SdfReader::merge(const Node& asker, const Instance& nested, const std::string& name,
                      std::size_t& bytes, Model& made) {
  if (nested.scale != 1.0 || nested.label != 0) {
    throw asker.error("found a scale or label on the nested model '" + nested.model->name +
                      "', expected them on static models only");
  }
  if (made.links.size() + nested.model->links.size() > kMaxLinks) {
    throw asker.error("found more than " + std::to_string(kMaxLinks) + " links, expected fewer");
  }
  bytes += bytes_of(*nested.model);
  if (bytes > kMaxModelBytes) {
    throw asker.error("found a model that takes more than " + std::to_string(kMaxModelBytes >> 20) +
                      " MB with what is merged into it, expected a smaller one");
  }
  merge_model(*nested.model, nested.pose, name, made);
}

std::size_t SdfReader::count_placements(const Model& model, const Source& source) {
  std::size_t count = model.links.empty() ? 0 : 1;
  for (const Instance& instance : model.instances) {
    const auto known = placements_.find(instance.model.get());
    count += known != placements_.end() ? known->second : 1;
    if (count > kMaxPlacements) {
      throw Error(source, "found more than " + std::to_string(kMaxPlacements) +
                              " static models, expected fewer");
    }
  }
  placements_[&model] = count;
  return count;
}

}  // namespace ardee
