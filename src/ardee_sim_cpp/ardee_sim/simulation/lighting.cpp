// SPDX-License-Identifier: MIT
// The world's lights: the part of Simulation that services ask for.
#include <algorithm>

#include "ardee_sim/simulation/simulation.h"

namespace ardee {
namespace {

std::vector<Light>::iterator find_light(std::vector<Light>& lights, const std::string& name) {
  const auto found = std::find_if(lights.begin(), lights.end(),
                                  [&name](const Light& light) { return light.name == name; });
  if (found == lights.end()) throw Error("light '" + name + "' does not exist");
  return found;
}

}  // namespace

void Simulation::set_light(const Light& light) {
  *find_light(world_.lights, light.name) = light;
  pictures_.relight();
}

void Simulation::remove_light(const std::string& name) {
  world_.lights.erase(find_light(world_.lights, name));
  pictures_.relight();
}

}  // namespace ardee
