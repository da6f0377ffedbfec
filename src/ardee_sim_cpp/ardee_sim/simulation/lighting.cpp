// SPDX-License-Identifier: MIT The world's lights: the part of Simulation for services.
#include <algorithm>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/render/sky_model.h"
#include "ardee_sim/simulation/simulation.h"

namespace ardee {
namespace {

std::vector<Light>::iterator find_light(std::vector<Light>& lights, const std::string& name) {
  return std::find_if(lights.begin(), lights.end(),
                      [&name](const Light& light) { return light.name == name; });
}

std::vector<Light>::iterator require_light(std::vector<Light>& lights, const std::string& name) {
  const auto found = find_light(lights, name);
  if (found == lights.end()) throw Error("light '" + name + "' does not exist");
  return found;
}

}  // namespace

void Simulation::add_light(const Light& light) {
  if (find_light(lights_, light.name) != lights_.end()) {
    throw Error("light '" + light.name + "' already exists");
  }
  if (!limits::is_valid(light.pose)) {
    throw Error("light '" + light.name + "': found a pose that is not finite or too far away");
  }
  lights_.push_back(light);
  pictures_.relight();
}

void Simulation::set_light(const Light& light) {
  *require_light(lights_, light.name) = light;
  pictures_.relight();
}

void Simulation::remove_light(const std::string& name) {
  lights_.erase(require_light(lights_, name));
  pictures_.relight();
}

void Simulation::set_daylight(const Daylight& day) {
  check_daylight(day);
  auto sun = std::find_if(lights_.begin(), lights_.end(), [](const Light& light) {
    return light.type == Light::Type::kDirectional;
  });
  if (sun == lights_.end()) {
    Light made;
    made.name = "sun";
    made.cast_shadows = true;
    add_light(made);
    sun = std::prev(lights_.end());
  }
  sun->diffuse.head<3>() = render::SkyModel(day).sun();
  sun->direction = sun->pose.q.conjugate() * -day.to_sun_W();
  daylight_ = day;
  pictures_.relight();
}

}  // namespace ardee
