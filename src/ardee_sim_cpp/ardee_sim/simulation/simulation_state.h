// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/description/daylight.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/raycast/picture_places.h"
#include "ardee_sim/simulation/handles.h"

namespace ardee {

/// A moment of a simulation, as data: its models, what moves them, their devices, commands, lights
/// and the latest readings. Made by Simulation::save.
struct SimulationState {
  struct EntityState {
    Instance instance;
    std::string robot_namespace;
    std::map<std::string, double> joint_positions;  // at the spawn
    std::uint32_t number = 0;                       // in the ray scenes
    std::uint64_t noise_seed = 0;
    Pose X_WM;            // of a static model
    std::string devices;  // of a StateArchive, as are the next
  };
  TimeNs now_ns = 0;
  std::uint64_t step_count = 0;
  std::uint32_t next_entity = 0;
  PhysicsParams physics;
  std::vector<Light> lights;
  std::optional<Daylight> daylight;
  std::vector<EntityState> entities;
  std::string dynamics;
  std::string commands;  // wrenches and efforts
  raycast::PicturePlaces picture_places;
  LatestReadings::Saved readings;
};

}  // namespace ardee
