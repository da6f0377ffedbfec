// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/manager.h"

#include <algorithm>
#include <map>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/nearest_names.h"
#include "ardee_sim/devices/names.h"

namespace ardee::control {

struct Manager::Loaded {
  Loaded(const ManagerContext& robot, const std::string& name, Setting own)
      : settings(std::move(own)), context{name,        robot.robot_namespace, settings,
                                          robot.model, robot.hardware,        robot.sensors,
                                          robot.log} {}

  Setting settings;
  ControllerContext context;
  std::string type;
  bool has_run = false;
  std::unique_ptr<Controller> controller;  // destroyed before the objects that it refers to
};

Manager::Manager(ManagerContext context, const ControllerTypes& types)
    : context_(std::move(context)), types_(types) {}

Manager::~Manager() = default;

Manager::Loaded* Manager::find_loaded(const std::string& name) const {
  for (const auto& each : loaded_) {
    if (each->context.name == name) return each.get();
  }
  return nullptr;
}

Controller* Manager::find(const std::string& name) const {
  const Loaded* loaded = find_loaded(name);
  return loaded ? loaded->controller.get() : nullptr;
}

Manager::Loaded& Manager::require(const std::string& name, const std::string& failure) const {
  if (Loaded* loaded = find_loaded(name)) return *loaded;
  throw Error(failure + " controller '" + name + "': no controller with this name is loaded");
}

Controller& Manager::load(const std::string& name) {
  const std::string failure = "could not load controller '" + name + "': ";
  if (find_loaded(name)) throw Error(failure + "one with this name is loaded already");
  const std::string path = devices::resolve_topic(name, context_.robot_namespace);
  auto loaded = std::make_unique<Loaded>(context_, name, context_.parameter(path));
  if (!loaded->settings.has("type")) {
    throw Error(failure + "found no parameter " + path +
                "/type, expected the type of the controller; are its parameters on the server?");
  }
  loaded->type = loaded->settings.text("type");
  const auto maker = types_.find(loaded->type);
  if (maker == types_.end()) {
    throw Error(failure + path + "/type: found '" + loaded->type + "', expected one of " +
                nearest_names(loaded->type, type_names()));
  }
  try {
    loaded->controller = maker->second(loaded->context);
  } catch (const Error& error) {
    throw Error(failure + error.what());
  }
  loaded_.push_back(std::move(loaded));
  return *loaded_.back()->controller;
}

void Manager::check_unload(const std::string& name) const {
  if (!require(name, "could not unload").controller->is_running()) return;
  throw Error("could not unload controller '" + name + "': it is running, expected it stopped");
}

void Manager::unload(const std::string& name) {
  check_unload(name);
  const Loaded& loaded = *find_loaded(name);
  loaded_.erase(std::find_if(loaded_.begin(), loaded_.end(),
                             [&loaded](const auto& each) { return each.get() == &loaded; }));
}

void Manager::unload_all() {
  for (const auto& each : loaded_) {
    if (each->controller->is_running()) stop(*each);
  }
  loaded_.clear();
}

void Manager::start(Loaded& loaded) {
  loaded.has_run = true;
  loaded.controller->start(now_ns_);
  loaded.controller->set_running(true);
}

void Manager::stop(Loaded& loaded) {
  loaded.controller->stop(now_ns_);
  loaded.controller->set_running(false);
}

void Manager::note(Change change, const std::vector<std::string>& names, Strictness strictness,
                   std::vector<Change>& changes) const {
  const bool shall_run = change == Change::kStart;
  const std::string failure = shall_run ? "could not start" : "could not stop";
  const bool is_strict = strictness == Strictness::kStrict;
  for (const std::string& name : names) {
    if (!is_strict && !find_loaded(name)) continue;
    const Loaded& loaded = require(name, failure);
    if (loaded.controller->is_running() == shall_run) {
      if (!is_strict) continue;
      throw Error(failure + " controller '" + name + "': it is " +
                  (shall_run ? "running already" : "not running"));
    }
    const auto place = std::find_if(loaded_.begin(), loaded_.end(),
                                    [&loaded](const auto& each) { return each.get() == &loaded; });
    changes[static_cast<std::size_t>(place - loaded_.begin())] = change;
  }
}

std::vector<Manager::Change> Manager::plan(const SwitchRequest& request) const {
  for (const std::string& name : request.start) {
    if (std::count(request.stop.begin(), request.stop.end(), name) > 0) {
      throw Error("conflicting switching command: found controller '" + name +
                  "' both to start and to stop");
    }
  }
  std::vector<Change> changes(loaded_.size(), Change::kNone);
  note(Change::kStop, request.stop, request.strictness, changes);
  note(Change::kStart, request.start, request.strictness, changes);
  return changes;
}

void Manager::check_conflicts(const std::vector<Change>& changes) const {
  std::map<std::string, std::string> claimed_by;  // controller, by joint
  for (std::size_t i = 0; i < loaded_.size(); ++i) {
    const Loaded& loaded = *loaded_[i];
    const bool runs = changes[i] == Change::kStart ||
                      (changes[i] == Change::kNone && loaded.controller->is_running());
    if (!runs) continue;
    for (const auto& [interface, joints] : loaded.controller->claims()) {
      for (const std::string& joint : joints) {
        const auto [other, is_free] = claimed_by.emplace(joint, loaded.context.name);
        if (is_free || other->second == loaded.context.name) continue;
        throw Error("could not switch controllers, due to resource conflict: '" + other->second +
                    "' and '" + loaded.context.name + "' both claim joint '" + joint + "'");
      }
    }
  }
}

void Manager::switch_controllers(const SwitchRequest& request) {
  const std::vector<Change> changes = plan(request);
  check_conflicts(changes);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (changes[i] == Change::kStop) stop(*loaded_[i]);
  }
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (changes[i] == Change::kStart) start(*loaded_[i]);
  }
}

std::vector<ControllerState> Manager::list() const {
  std::vector<ControllerState> all;
  for (const auto& each : loaded_) {
    const char* at_rest = each->has_run ? "stopped" : "initialized";
    ControllerState state{
        each->context.name, each->type, each->controller->is_running() ? "running" : at_rest, {}};
    for (const auto& [interface, joints] : each->controller->claims()) {
      state.claims.push_back({interface_name(interface), {joints.begin(), joints.end()}});
    }
    if (state.claims.empty())
      state.claims.push_back({"hardware_interface::JointStateInterface", {}});
    all.push_back(std::move(state));
  }
  return all;
}

std::vector<std::string> Manager::type_names() const {
  std::vector<std::string> names;
  for (const auto& [name, maker] : types_) names.push_back(name);
  return names;
}

void Manager::update(TimeNs now_ns, double period_s, devices::ReadingSink& sink) {
  now_ns_ = now_ns;
  for (const auto& each : loaded_) {
    if (each->controller->is_running()) each->controller->update(now_ns, period_s, sink);
  }
}

void Manager::restart(TimeNs now_ns) {
  now_ns_ = now_ns;
  for (const auto& each : loaded_) {
    if (!each->controller->is_running()) continue;
    stop(*each);
    start(*each);
  }
}

void Manager::reset(TimeNs now_ns) {
  now_ns_ = now_ns;
  for (const auto& each : loaded_) {
    const bool ran = each->controller->is_running();
    if (ran) stop(*each);
    each->controller->reset(now_ns);
    if (ran) start(*each);
  }
}

void Manager::load_only(const std::vector<std::string>& names) {
  std::vector<std::unique_ptr<Loaded>> kept;
  for (const std::string& name : names) {
    if (!find_loaded(name)) load(name);
    const auto place = std::find_if(loaded_.begin(), loaded_.end(), [&name](const auto& each) {
      return each->context.name == name;
    });
    kept.push_back(std::move(*place));
    loaded_.erase(place);
  }
  unload_all();
  loaded_ = std::move(kept);
}

void Manager::serialize(StateArchive& state) {
  std::vector<std::string> names;
  for (const auto& each : loaded_) names.push_back(each->context.name);
  state(names);
  if (state.is_restoring()) load_only(names);
  for (const auto& each : loaded_) {
    bool is_running = each->controller->is_running();
    state(each->has_run, is_running, *each->controller);
    each->controller->set_running(is_running);
  }
  state(now_ns_);
}

}  // namespace ardee::control
