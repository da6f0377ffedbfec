// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/description/scenery.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/robot.h"

namespace ardee {

/// A model of the world: a robot with its devices, or a piece of scenery with all models that it
/// includes.
struct Entity {
  Instance instance;  // as it was spawned: name, model, initial pose
  std::string robot_namespace;
  std::map<std::string, double> joint_positions;
  std::unique_ptr<devices::Robot> robot;
  std::vector<std::unique_ptr<devices::Device>> devices;
  std::vector<Placement> placements;  // static: the k-th has the ray entity robot->entity() + k
  physics::PhysicsWorld::SceneryId scenery = 0;
  std::optional<TimeNs> told_put_back_ns = std::nullopt;  // time of the last log message about it

  const std::string& name() const { return instance.name; }
  bool is_static() const { return instance.is_static; }
};

}  // namespace ardee
