// SPDX-License-Identifier: MIT
// The state of a simulation as bytes, for another process too.
#include <pybind11/stl.h>

#include <utility>

#include "simulation.h"

namespace ardee::python {
namespace {

constexpr std::uint32_t kVersion = 5;

void serialize(StateArchive& archive, PhysicsParams& p) {
  archive(p.step_s, p.real_time_update_rate_hz, p.gravity_m_per_s2, p.solver, p.iterations, p.sor,
          p.cfm, p.erp, p.max_correcting_velocity_m_per_s, p.contact_surface_layer_m,
          p.max_contacts);
}

void serialize(StateArchive& archive, Light& light) {
  archive(light.name, light.type, light.pose, light.diffuse, light.specular, light.direction,
          light.cast_shadows, light.range_m, light.attenuation_constant, light.attenuation_linear,
          light.attenuation_quadratic, light.inner_angle_rad, light.outer_angle_rad, light.falloff);
}

}  // namespace

std::shared_ptr<const Model> BoundSimulation::model_of(const std::string& name,
                                                       const std::string& text,
                                                       const std::string& file) {
  if (text.empty()) {
    for (const Instance& instance : world_->world()->models) {
      if (instance.name == name) return instance.model;
    }
    StateArchive::refuse();
  }
  const auto known = spawned_.find(name);
  const bool is_known = known != spawned_.end() && known->second->text == text;
  return (restored_[name] = is_known ? known->second : world_->load_model(text, file))->model;
}

void BoundSimulation::save_entity(StateArchive& archive, SimulationState::EntityState& entity) {
  Instance& instance = entity.instance;
  std::string text, file;
  const auto known = spawned_.find(instance.name);
  if (!archive.is_restoring() && known != spawned_.end()) {
    text = known->second->text;
    file = known->second->name;
  }
  std::vector<std::pair<std::string, double>> joints(entity.joint_positions.begin(),
                                                     entity.joint_positions.end());
  archive(instance.name, text, file, instance.pose, instance.scale, instance.label,
          instance.is_static, entity.robot_namespace, joints, entity.number, entity.noise_seed,
          entity.X_WM, entity.devices);
  if (!archive.is_restoring()) return;
  entity.joint_positions = {joints.begin(), joints.end()};
  instance.model = model_of(instance.name, text, file);
  if (!text.empty()) return;
  for (const Instance& each : world_->world()->models) {
    if (each.name == instance.name) instance.link_states = each.link_states;
  }
}

void BoundSimulation::serialize(StateArchive& archive, SimulationState& state) {
  std::uint32_t version = kVersion;
  std::size_t world = world_->fingerprint();
  std::uint64_t seed = seed_;
  const std::size_t own_world = world;
  archive(version, world, seed);
  if (version != kVersion || world != own_world || seed != seed_) {
    throw Error(
        "found a snapshot of another world, seed or version, expected one of this world "
        "with seed " +
        std::to_string(seed_));
  }
  archive(state.now_ns, state.step_count, state.next_entity, state.dynamics, state.commands,
          state.picture_places);
  python::serialize(archive, state.physics);
  archive.size_of(state.lights);
  for (Light& light : state.lights) python::serialize(archive, light);
  archive(state.daylight);
  archive.size_of(state.entities);
  for (SimulationState::EntityState& entity : state.entities) save_entity(archive, entity);
  archive.finish();
}

py::bytes BoundSimulation::snapshot() {
  const Use use(*this);
  SimulationState state = use->save();
  StateArchive archive;
  serialize(archive, state);
  return py::bytes(archive.bytes());
}

void BoundSimulation::restore(const std::string& bytes) {
  const Use use(*this);
  StateArchive archive(bytes);
  SimulationState state;
  restored_.clear();
  serialize(archive, state);
  use->restore(state);
  spawned_ = std::exchange(restored_, {});
  inbox_.clear();
  touches_.clear();
  apply_demands();
}

}  // namespace ardee::python
