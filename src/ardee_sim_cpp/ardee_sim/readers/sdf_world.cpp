// SPDX-License-Identifier: MIT
#include <algorithm>

#include "ardee_sim/readers/gz_systems.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/schema.h"
#include "ardee_sim/readers/sdf_link.h"
#include "ardee_sim/readers/sdf_population.h"
#include "ardee_sim/readers/sdf_reader.h"
#include "ardee_sim/readers/sdf_scene.h"
#include "ardee_sim/readers/sdf_state.h"

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

/// Of a part of a world, as far as it is written: an include may have its model's.
std::string name_of(const Node& part) {
  return part.name() == "include" ? part.text("name", "") : part.attribute("name");
}

/// A part of a world in messages: "<model> 'wall'".
std::string label_of(const Node& part) {
  std::string name = name_of(part);
  if (name.empty()) name = part.text("uri", "");
  return "<" + std::string(part.name()) + "> '" + name + "'";
}

}  // namespace

World SdfReader::read_world(const Node& root) {
  const Scope scope{read_version(root), std::nullopt};
  sdf_schema().check(root, assets_.log());
  const Node node = root.required("world");
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

/// Adds what was put into the world after it had been loaded.
void SdfReader::read_insertions(const Node& insertions, const Scope& scope, World& made) {
  const auto is_there = [this](const auto& items, const Node& inserted) {
    const std::string name = inserted.required_attribute("name");
    const bool found = std::any_of(items.begin(), items.end(),
                                   [&name](const auto& item) { return item.name == name; });
    if (found) {
      assets_.log().warn(inserted.source(), "found in the world already, left out",
                         ": '" + name + "'");
    }
    return found;
  };
  const auto add_model = [&](const Node& inserted) {
    if (is_there(made.models, inserted)) return;
    Instance instance;
    instance.model = read_model(inserted, scope);
    instance.name = instance.model->name;
    instance.pose = place_model(inserted.pose(), instance.model->X_MP);
    instance.is_static = instance.model->is_static;
    made.models.push_back(std::move(instance));
  };
  insertions.each("model", [&](const Node& inserted) {
    assets_.is_good(label_of(inserted), [&] { add_model(inserted); });
  });
  insertions.each("light", [&](const Node& inserted) {
    assets_.is_good(label_of(inserted), [&] {
      if (!is_there(made.lights, inserted)) made.lights.push_back(read_sdf_light(inserted));
    });
  });
}

/// A line of text asks for as many models as it likes; they have to fit into memory.
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

struct SdfReader::WorldParts {
  World& made;
  UniqueNames names{};
  UniqueNames light_names{};
  SdfFrames frames{"world"};

  void add_light(Light light) {
    light.name = light_names.claim(light.name);
    made.lights.push_back(std::move(light));
  }
};

void SdfReader::read_world_models(const Node& world, const Scope& scope, World& made) {
  WorldParts parts{made};
  world.each([&](const Node& part) {
    assets_.is_good(label_of(part), [&] { parts.frames.add_child(part); });
  });
  world.each([&](const Node& part) {
    const bool good = assets_.is_good(label_of(part), [&] { read_world_part(part, scope, parts); });
    if (!good && !parts.names.is_taken(name_of(part))) parts.frames.forget(name_of(part));
  });
}

/// Adds a part when all of it is read: on a throw nothing of it is there.
void SdfReader::read_world_part(const Node& part, const Scope& scope, WorldParts& parts) {
  const std::string_view kind = part.name();
  if (kind == "include") {
    add_world_include(part, parts);
  } else if (kind == "model") {
    add_world_model(part, scope, parts);
  } else if (kind == "light") {
    parts.add_light(read_sdf_light(part));
  } else if (kind == "plugin") {
    PluginDescription plugin = read_plugin(part);
    if (!is_settled_gz_system(plugin)) parts.made.plugins.push_back(std::move(plugin));
  } else if (kind == "population") {
    add_population(part, scope, parts);
  }
}

void SdfReader::add_world_include(const Node& include, WorldParts& parts) {
  const ModelFile& file = included_file(include, std::nullopt);
  if (file.model) {
    if (include.has_attribute("merge")) {
      assets_.log().warn(include.source(), "found merge, which acts on an <include> in a <model>");
    }
    Instance instance = read_include(include, file, parts.names, parts.frames);
    parts.frames.replace(instance.name, instance.pose);
    parts.frames.add_links(instance.name, file.model);
    parts.made.models.push_back(std::move(instance));
  }
  for (const Light& light : file.lights) parts.add_light(light);
}

void SdfReader::add_world_model(const Node& model, const Scope& scope, WorldParts& parts) {
  Instance instance;
  instance.model = read_model(model, scope);
  instance.pose = place_model(parts.frames.pose(model), instance.model->X_MP);
  instance.is_static = instance.model->is_static;
  instance.name = parts.names.claim(instance.model->name);
  if (instance.name != instance.model->name) {
    assets_.log().warn(model.source(), "a second model of one name gets another",
                       ": '" + instance.name + "'");
  }
  parts.frames.replace(instance.name, instance.pose);
  parts.frames.add_links(instance.name, instance.model);
  parts.made.models.push_back(std::move(instance));
}

/// Copies are named as Gazebo does it.
void SdfReader::add_population(const Node& population, const Scope& scope, WorldParts& parts) {
  const std::vector<Eigen::Vector3d> places = read_population(population);
  if (parts.made.models.size() + places.size() > std::size_t{kMaxPopulation}) {
    throw population.error("found more than " + std::to_string(kMaxPopulation) +
                           " models with those before, expected fewer");
  }
  const Pose X_WP = parts.frames.pose(population);
  Instance instance;
  instance.model = read_model(population.required("model"), scope);
  instance.is_static = instance.model->is_static;
  for (std::size_t k = 0; k < places.size(); ++k) {
    instance.name = parts.names.claim(instance.model->name + "_clone_" + std::to_string(k));
    instance.pose = X_WP;
    instance.pose.p += X_WP.q * places[k];
    parts.made.models.push_back(instance);
  }
}

}  // namespace ardee
