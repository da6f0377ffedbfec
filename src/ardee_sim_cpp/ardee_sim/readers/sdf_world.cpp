// SPDX-License-Identifier: MIT
#include <set>

#include "ardee_sim/readers/gz_systems.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/sdf_parts.h"
#include "ardee_sim/readers/sdf_reader.h"

namespace ardee {
namespace {

/// As in Gazebo the first <state> counts.
std::optional<Node> saved_state(const Node& world, Log& log) {
  std::optional<Node> first;
  world.each("state", [&](const Node& state) {
    if (first) log.warn(state.source(), "found a second <state>, the first counts");
    if (!first) first = state;
  });
  return first;
}

/// A light alone in its file has the pose and the name of its <include>.
void adopt_place(const Node& include, const SdfFrames& frames, Light& light) {
  light.name = include.text("name", light.name);
  if (include.child("pose")) light.pose = frames.pose(include);
}

}  // namespace

std::string label_of(const Node& part) {
  const bool is_include = part.name() == "include";
  const std::string name =
      is_include ? part.text("name", part.text("uri", "")) : part.attribute("name");
  return "<" + std::string(part.name()) + "> '" + name + "'";
}

World SdfReader::read_world(const Node& root) {
  const Scope scope{read_version(root), std::nullopt};
  sdf_schema().check(root, assets_.log());
  const Node node = root.required("world");
  warn_of_others(root, node);
  World made;
  made.name = node.attribute("name", made.name);
  made.source = node.source();
  made.physics = read_sdf_physics(node, assets_.log());
  if (const auto scene = node.child("scene")) made.scene = read_sdf_scene(*scene);
  if (const auto camera = node.find("gui/camera")) made.gui_camera = camera->pose();
  if (const auto place = node.child("spherical_coordinates")) {
    made.spherical_coordinates = read_spherical_coordinates(*place);
  }
  reading_.assign(1, root.file());
  read_world_models(node, scope, made);
  const auto state = saved_state(node, assets_.log());
  const auto insertions = state ? state->child("insertions") : std::nullopt;
  if (insertions) read_insertions(*insertions, scope, made);
  reading_.clear();
  check_size(made);
  if (state) apply_sdf_state(*state, made, assets_.log());
  return made;
}

/// Adds the models inserted after the world was loaded.
void SdfReader::read_insertions(const Node& insertions, const Scope& scope, World& made) {
  std::set<std::string> models;
  std::set<std::string> lights;
  for (const Instance& instance : made.models) models.insert(instance.name);
  for (const Light& light : made.lights) lights.insert(light.name);
  const auto is_there = [this](std::set<std::string>& names, const Node& inserted) {
    const std::string name = inserted.required_attribute("name");
    const bool found = !names.insert(name).second;
    if (found) {
      assets_.log().warn(inserted.source(), "found in the world already, left out",
                         ": '" + name + "'");
    }
    return found;
  };
  const auto add_model = [&](const Node& inserted) {
    if (is_there(models, inserted)) return;
    Instance instance;
    instance.model = read_model(inserted, scope);
    instance.name = instance.model->name;
    instance.pose = place_model(inserted.pose(), instance.model->X_MP);
    instance.is_static = instance.model->is_static;
    made.models.push_back(std::move(instance));
  };
  const auto add_light = [&](const Node& inserted) {
    if (is_there(lights, inserted)) return;
    made.lights.push_back(read_sdf_light(inserted, inserted.pose()));
  };
  insertions.each("model", [&](const Node& inserted) {
    assets_.is_good(label_of(inserted), [&] { add_model(inserted); });
  });
  insertions.each("light", [&](const Node& inserted) {
    assets_.is_good(label_of(inserted), [&] { add_light(inserted); });
  });
}

/// Bounds the number of models, as one line of text can ask for any number.
void SdfReader::check_size(const World& world) const {
  std::size_t placements = 0;
  std::size_t moving_links = 0;
  for (const Instance& instance : world.models) {
    if (instance.is_static) {
      placements += placements_.at(instance.model.get());
    } else {
      moving_links += instance.model->links.size();
    }
    if (placements > kMaxPlacements || moving_links > kMaxLinks) {
      throw Error(world.source, placements > kMaxPlacements
                                    ? "found more than " + std::to_string(kMaxPlacements) +
                                          " static models, expected fewer"
                                    : "found more than " + std::to_string(kMaxLinks) +
                                          " links of models that move, expected fewer");
    }
  }
}

void SdfReader::read_world_models(const Node& world, const Scope& scope, World& made) {
  UniqueNames names;
  UniqueNames light_names;
  SdfFrames frames("world");
  world.each([&](const Node& child) {
    assets_.is_good(label_of(child), [&] { frames.add_child(child); });
  });
  std::vector<Placed> placed = read_placed(world, scope, names, frames);
  auto next = placed.begin();
  const auto add_light = [&](Light light) {
    light.name = light_names.claim(light.name);
    made.lights.push_back(std::move(light));
  };
  const auto add_placed = [&](const Node& child, Placed from) {
    if (child.has_attribute("merge")) {
      assets_.log().warn(child.source(), "found merge, which acts on an <include> in a <model>");
    }
    if (from.instance) {
      Instance& instance = *from.instance;
      instance.pose = frames.find(instance.name, child.child("pose").value_or(child));
      made.models.push_back(std::move(instance));
    }
    for (Light& light : from.lights) {
      if (!from.instance) adopt_place(child, frames, light);
      add_light(std::move(light));
    }
  };
  const auto add = [&](const Node& child) {
    const std::string_view kind = child.name();
    if (is_nested(child)) {
      add_placed(child, std::move(*next++));
    } else if (kind == "light") {
      add_light(read_sdf_light(child, frames.pose(child)));
    } else if (kind == "plugin") {
      PluginDescription plugin = read_plugin(child);
      if (!is_settled_gz_system(plugin)) made.plugins.push_back(std::move(plugin));
    } else if (kind == "population") {
      add_population(child, scope, names, frames, made);
    }
  };
  world.each([&](const Node& child) { assets_.is_good(label_of(child), [&] { add(child); }); });
}

/// Copies are named as in Gazebo.
void SdfReader::add_population(const Node& population, const Scope& scope, UniqueNames& names,
                               const SdfFrames& frames, World& made) {
  const std::vector<Eigen::Vector3d> places = read_population(population);
  if (made.models.size() + places.size() > std::size_t{kMaxPopulation}) {
    throw population.error("found more than " + std::to_string(kMaxPopulation) +
                           " models with those before, expected fewer");
  }
  const Pose X_WP = frames.pose(population);
  Instance instance;
  instance.model = read_model(population.required("model"), scope);
  instance.is_static = instance.model->is_static;
  for (std::size_t k = 0; k < places.size(); ++k) {
    instance.name = names.claim(instance.model->name + "_clone_" + std::to_string(k));
    instance.pose = X_WP;
    instance.pose.p += X_WP.q * places[k];
    made.models.push_back(instance);
  }
}

}  // namespace ardee
