// SPDX-License-Identifier: MIT
// Saving a simulation's state, and going on from it.
#include <algorithm>

#include "ardee_sim/simulation/simulation.h"

namespace ardee {
namespace {

bool is_same(const Entity& entity, const SimulationState::EntityState& saved) {
  return entity.instance.model == saved.instance.model && entity.robot->entity() == saved.number;
}

void serialize_devices(StateArchive& archive, const Entity& entity) {
  for (const auto& device : entity.devices) archive(*device);
  archive.finish();
}

}  // namespace

SimulationState Simulation::save() {
  SimulationState state;
  state.now_ns = now_ns_;
  state.step_count = step_count_;
  state.next_entity = next_entity_;
  state.physics = physics_.params();
  state.lights = lights_;
  state.daylight = daylight_;
  for (const auto& entity : entities_) {
    StateArchive devices;
    serialize_devices(devices, *entity);
    state.entities.push_back({entity->instance, entity->robot_namespace, entity->joint_positions,
                              entity->robot->entity(), entity->robot->noise_seed(),
                              entity->robot->pose(), devices.bytes()});
  }
  StateArchive dynamics, commands;
  dynamics(physics_);
  serialize_commands(commands);
  state.dynamics = dynamics.bytes();
  state.commands = commands.bytes();
  state.picture_places = scenes_.picture_places();
  state.readings = latest_.save();
  return state;
}

void Simulation::serialize_commands(StateArchive& archive) {
  const auto robot = [this](std::uint32_t number) {
    const auto found = std::find_if(entities_.begin(), entities_.end(), [number](const auto& each) {
      return each->robot->entity() == number;
    });
    if (found == entities_.end()) StateArchive::refuse();
    return (*found)->robot.get();
  };
  wrenches_.serialize(archive, robot);
  joint_efforts_.serialize(archive, robot);
  archive.finish();
}

void Simulation::keep_only(const std::vector<SimulationState::EntityState>& wanted) {
  std::map<std::string, std::size_t> place;  // in `wanted`
  for (const SimulationState::EntityState& each : wanted) {
    place.emplace(each.instance.name, place.size());
  }
  std::vector<std::string> others;
  for (const auto& entity : entities_) {
    const auto found = place.find(entity->name());
    if (found == place.end() || !is_same(*entity, wanted[found->second])) {
      others.push_back(entity->name());
    }
  }
  for (const std::string& name : others) remove(name);
  for (const SimulationState::EntityState& each : wanted) {
    if (find(each.instance.name)) continue;
    auto entity = std::make_unique<Entity>();
    entity->instance = each.instance;
    entity->robot_namespace = each.robot_namespace;
    entity->joint_positions = each.joint_positions;
    next_entity_ = each.number;
    add(std::move(entity));
  }
  std::sort(entities_.begin(), entities_.end(), [&place](const auto& one, const auto& other) {
    return place.at(one->name()) < place.at(other->name());
  });
}

void Simulation::restore(const SimulationState& state) {
  const LogGroup group(log_);
  now_ns_ = state.now_ns;
  step_count_ = state.step_count;
  set_physics(state.physics);
  keep_only(state.entities);
  next_entity_ = state.next_entity;
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    entities_[i]->robot->set_noise_seed(state.entities[i].noise_seed);
  }
  reset_entities();
  StateArchive dynamics(state.dynamics), commands(state.commands);
  dynamics(physics_);
  dynamics.finish();
  for (std::size_t i = 0; i < entities_.size(); ++i) {
    const SimulationState::EntityState& saved = state.entities[i];
    if (entities_[i]->is_static()) place_static(*entities_[i], saved.X_WM);
    StateArchive devices(saved.devices);
    serialize_devices(devices, *entities_[i]);
  }
  serialize_commands(commands);
  lights_ = state.lights;
  daylight_ = state.daylight;
  pictures_.relight();
  scenes_.set_picture_places(state.picture_places);
  scenes_.invalidate();
  latest_.restore(state.readings);
}

}  // namespace ardee
