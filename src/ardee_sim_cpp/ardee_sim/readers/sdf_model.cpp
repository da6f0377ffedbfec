// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/sdf_joint.h"
#include "ardee_sim/readers/sdf_link.h"
#include "ardee_sim/readers/sdf_reader.h"
#include "ardee_sim/readers/validate.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxLinks = 100'000;

/// The one named by the attribute, else the first.
void choose_canonical_link(const Node& node, const SdfFrames& frames, Model& model) {
  if (model.links.empty()) return;
  const std::string named = node.attribute("canonical_link");
  model.canonical_link = named.empty() ? model.links.front().name : frames.body_of(named);
  if (model.find_link(model.canonical_link) == nullptr) {
    throw node.error(unknown_link(named, model));
  }
}

}  // namespace

double SdfReader::read_version(const Node& root) {
  const std::string text = root.attribute("version");
  if (text.empty()) {
    assets_.log().warn_once(root.source().to_string() + ": found no version, read as SDF 1.7");
    return kNewestSdf;
  }
  char* end = nullptr;
  const double version = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != '\0' || !(version >= 1.0 && version < 100.0)) {
    throw root.error("found version '" + text + "', expected 1.2 to 1.7");
  }
  if (version > kNewestSdf + 1e-9) {
    assets_.log().warn_once(root.source().to_string() + ": found version " + text +
                            ", read as SDF 1.7");
  }
  return version;
}

std::shared_ptr<const Model> SdfReader::read_model(const Node& root) {
  const Scope scope{read_version(root), std::nullopt};
  sdf_schema().warn_of_unknown(root, "SDF", assets_.log());
  reading_.assign(1, root.file());
  // gazebo_ros's spawn scripts wrap what they take from the model database in a world.
  const auto world = root.child("world");
  const auto include = world ? world->child("include") : std::nullopt;
  std::shared_ptr<const Model> model;
  if (!root.child("model") && include) {
    model = included_file(*include, std::nullopt).model;
    if (!model) throw include->error("found no model in what it names, expected one");
  } else {
    model =
        read_own_model((world && !root.child("model") ? *world : root).required("model"), scope);
  }
  reading_.clear();
  return model;
}

std::shared_ptr<const Model> SdfReader::read_own_model(const Node& node, const Scope& scope) {
  const auto made = read_model(node, scope);
  made->own_pose = node.pose();
  return made;
}

std::shared_ptr<Model> SdfReader::read_model(const Node& node, const Scope& scope) {
  auto made = std::make_shared<Model>();
  made->name = node.required_attribute("name");
  made->source = node.source();
  made->is_static = scope.make_static.value_or(node.boolean("static", false));
  made->self_collide = node.boolean("self_collide", false);
  SdfFrames frames("__model__");
  frames.add_children(node);
  node.each("link", [&](const Node& link) {
    made->links.push_back(read_sdf_link(link, frames, assets_));
    if (made->self_collide) made->links.back().self_collide = true;
  });
  node.each("plugin", [&](const Node& plugin) { made->plugins.push_back(read_plugin(plugin)); });
  UniqueNames names;
  read_nested(node, {scope.version, made->is_static ? std::optional<bool>(true) : std::nullopt},
              names, frames, *made);
  choose_canonical_link(node, frames, *made);
  node.each("joint", [&](const Node& joint) {
    made->joints.push_back(read_sdf_joint(joint, scope.version, frames, *made));
  });
  validate_model(*made, assets_.log());
  count_placements(*made, made->source);
  return made;
}

void SdfReader::read_nested(const Node& model, const Scope& scope, UniqueNames& names,
                            SdfFrames& frames, Model& made) {
  model.each([&](const Node& child) {
    if (child.name() == "include") {
      const ModelFile& file = included_file(child, scope.make_static);
      if (!file.model && file.lights.empty()) return;
      if (!file.model) {
        assets_.log().warn_once(child.source().to_string() +
                                ": a light within a model is not supported, left out");
        return;
      }
      Instance nested = read_include(child, file, names, frames);
      frames.add(nested.name, nested.pose);
      frames.add_links(nested.name, nested.model);
      add_nested(std::move(nested), made);
    } else if (child.name() == "model") {
      Instance nested;
      nested.model = read_model(child, scope);
      nested.name = names.claim(nested.model->name);
      nested.pose = frames.pose(child);
      nested.is_static = nested.model->is_static;
      frames.add_links(nested.name, nested.model);
      add_nested(std::move(nested), made);
    } else if (child.name() == "ardee:instances") {
      read_instances(child, names, made);
    } else if (child.name() == "gripper") {
      assets_.log().warn(child.source().to_string() + ": not supported, left out");
    }
  });
}

void SdfReader::add_nested(Instance nested, Model& made) {
  if (nested.is_static) {
    made.instances.push_back(std::move(nested));
    return;
  }
  if (nested.scale != 1.0 || nested.label != 0) {
    throw Error(made.source, "found a scale or label on the nested model '" + nested.name +
                                 "', expected them on static models only");
  }
  if (made.links.size() + nested.model->links.size() > kMaxLinks) {
    throw Error(made.source,
                "found more than " + std::to_string(kMaxLinks) + " links, expected fewer");
  }
  merge_model(*nested.model, nested.pose, nested.name, made);
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
