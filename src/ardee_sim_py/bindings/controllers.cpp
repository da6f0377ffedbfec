// SPDX-License-Identifier: MIT
// Controllers of ros_control, with their parameters.
#include <pybind11/stl.h>

#include "ardee_sim/controllers/ros_control.h"
#include "simulation.h"

namespace ardee::python {
namespace {

constexpr int kMostLevels = 20;  // as in a YAML file; a group that holds itself has no end

Setting to_setting(const std::string& path, const py::handle& value, int level = 0) {
  if (level > kMostLevels) throw Error("found more than 20 levels of parameters, expected fewer");
  if (py::isinstance<py::bool_>(value)) return {path, value.cast<bool>()};
  if (py::isinstance<py::float_>(value)) return {path, value.cast<double>()};
  if (py::isinstance<py::str>(value)) return {path, value.cast<std::string>()};
  if (py::isinstance<py::int_>(value)) {
    int overflows = 0;
    const long long number = PyLong_AsLongLongAndOverflow(value.ptr(), &overflows);
    if (overflows != 0 || number != static_cast<int>(number)) {
      throw Error(path + ": found " + py::str(value).cast<std::string>() +
                  ", expected a whole number of 32 bits");
    }
    return {path, static_cast<int>(number)};
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    Setting::List list;
    for (const py::handle& item : value) {
      list.push_back(to_setting(path + "[" + std::to_string(list.size()) + "]", item, level + 1));
    }
    return {path, list};
  }
  if (py::isinstance<py::dict>(value)) {
    Setting::Map map;
    for (const auto& [key, item] : value.cast<py::dict>()) {
      const std::string name = py::str(key);
      if (name.find('/') != std::string::npos) {
        throw Error(path + ": found the name '" + name + "', expected a group in place of a slash");
      }
      map.emplace(name, to_setting(path + "/" + name, item, level + 1));
    }
    return {path, map};
  }
  throw Error(path + ": found " + py::repr(value).cast<std::string>() +
              ", expected a number, a truth, a text, a list or a group");
}

/// Groups are merged; any other value takes the place of the one that was there.
Setting merged(const Setting& base, const Setting& over) {
  const auto* below = std::get_if<Setting::Map>(&base.value());
  const auto* above = std::get_if<Setting::Map>(&over.value());
  if (below == nullptr || above == nullptr) return over;
  Setting::Map map = *below;
  for (const auto& [name, setting] : *above) map[name] = merged(map[name], setting);
  return {over.path(), map};
}

control::Manager& manager_of(Simulation& simulation, const std::string& model) {
  const Entity* entity = simulation.find(model);
  if (entity == nullptr) throw Error("found no model '" + model + "'");
  for (const auto& device : entity->devices) {
    if (auto* found = dynamic_cast<control::RosControl*>(device.get())) return found->manager();
  }
  throw Error("found model '" + model +
              "' without a controller manager, expected one with the plugin "
              "libgazebo_ros_control.so and transmissions");
}

}  // namespace

void BoundSimulation::set_parameters(const py::dict& parameters) {
  const Use use(*this);
  parameters_ = merged(parameters_, to_setting("", parameters));
}

void BoundSimulation::start_controllers(const std::string& model,
                                        const std::vector<std::string>& names) {
  const Use use(*this);
  control::Manager& manager = manager_of(*use, model);
  std::vector<std::string> loaded;
  try {
    for (const std::string& name : names) {
      if (manager.find(name) != nullptr) continue;
      manager.load(name);
      loaded.push_back(name);
    }
    manager.switch_controllers({names, {}, control::Strictness::kStrict});
  } catch (const Error&) {
    for (const std::string& name : loaded) manager.unload(name);
    throw;
  }
  apply_demands();
}

void BoundSimulation::stop_controllers(const std::string& model,
                                       const std::vector<std::string>& names) {
  const Use use(*this);
  manager_of(*use, model).switch_controllers({{}, names, control::Strictness::kStrict});
}

py::dict BoundSimulation::controllers(const std::string& model) {
  const Use use(*this);
  py::dict states;
  for (const control::ControllerState& each : manager_of(*use, model).list()) {
    states[py::str(each.name)] = each.state;
  }
  return states;
}

}  // namespace ardee::python
