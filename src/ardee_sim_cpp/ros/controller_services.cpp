// SPDX-License-Identifier: MIT
#include "ros/controller_services.h"

#include <controller_manager_msgs/ListControllerTypes.h>
#include <controller_manager_msgs/ListControllers.h>
#include <controller_manager_msgs/LoadController.h>
#include <controller_manager_msgs/ReloadControllerLibraries.h>
#include <controller_manager_msgs/SwitchController.h>
#include <controller_manager_msgs/UnloadController.h>

#include "ardee_sim/core/error.h"
#include "ardee_sim/devices/names.h"
#include "ros/command_subscription.h"

namespace ardee::node {
namespace {

namespace msgs = controller_manager_msgs;

msgs::ControllerState to_message(const control::ControllerState& state) {
  msgs::ControllerState message;
  message.name = state.name;
  message.type = state.type;
  message.state = state.state;
  for (const control::Claim& claim : state.claims) {
    auto& resources = message.claimed_resources.emplace_back();
    resources.hardware_interface = claim.interface;
    resources.resources = claim.joints;
  }
  return message;
}

}  // namespace

ControllerServices::ControllerServices(const ros::NodeHandle& node, control::RosControl& device,
                                       const devices::Robot& robot, Routes& routes, Log log)
    : node_(node),
      manager_(device.manager()),
      space_(device.robot_namespace()),
      robot_(robot),
      routes_(routes),
      log_(std::move(log)),
      servers_(node) {
  serve<msgs::ListControllers>("list_controllers", [this](const auto&, auto& response) {
    for (const auto& each : manager_.list()) response.controller.push_back(to_message(each));
  });
  serve<msgs::ListControllerTypes>("list_controller_types", [this](const auto&, auto& response) {
    response.types = manager_.type_names();
    response.base_classes.assign(response.types.size(), "controller_interface::ControllerBase");
  });
  serve<msgs::LoadController>("load_controller", [this](const auto& request, auto& response) {
    response.ok = attempt([&] { load(request.name); });
  });
  serve<msgs::UnloadController>("unload_controller", [this](const auto& request, auto& response) {
    response.ok = attempt([&] { unload(request.name); });
  });
  serve<msgs::SwitchController>("switch_controller", [this](const auto& request, auto& response) {
    response.ok = attempt([&] {
      switch_controllers({request.start_controllers, request.stop_controllers}, request.strictness);
    });
  });
  serve<msgs::ReloadControllerLibraries>(
      "reload_controller_libraries", [this](const auto& request, auto& response) {
        response.ok = attempt([&] { reload(request.force_kill); });
      });
}

template <typename Service, typename Act>
void ControllerServices::serve(const std::string& name, Act act) {
  const std::string full = devices::resolve_topic("controller_manager/" + name, space_);
  require_valid(full);
  if (!is_free_service(full)) {
    taken_.push_back(full);
    return;
  }
  servers_.add<Service>(full, full, [act](const auto& request, auto& response) {
    act(request, response);
    return std::string();
  });
}

template <typename Act>
bool ControllerServices::attempt(Act act) {
  try {
    act();
    return true;
  } catch (const Error& error) {
    log_.error(error.what());
    return false;
  }
}

void ControllerServices::load(const std::string& name) {
  control::Controller& controller = manager_.load(name);
  try {
    auto topics = std::make_unique<PortTopics>(node_, controller.ports(), robot_, "", routes_);
    warn_of_taken(topics->taken(), robot_, log_);
    topics_[name] = std::move(topics);
  } catch (const Error& error) {
    manager_.unload(name);
    throw Error("could not load controller '" + name + "': " + error.what());
  }
  log_.info("loaded controller '" + name + "'");
}

void ControllerServices::unload(const std::string& name) {
  manager_.check_unload(name);
  topics_.erase(name);  // before the outputs that they publish
  manager_.unload(name);
}

void ControllerServices::switch_controllers(control::SwitchRequest request, int strictness) {
  using Request = msgs::SwitchControllerRequest;
  if (strictness == 0) {
    log_.warn(
        "switch_controller: found strictness 0, expected BEST_EFFORT (1) or STRICT (2); it "
        "is taken as BEST_EFFORT");
  }
  request.strictness = strictness == Request::STRICT ? control::Strictness::kStrict
                                                     : control::Strictness::kBestEffort;
  manager_.switch_controllers(request);
}

void ControllerServices::reload(bool force_kill) {
  const std::size_t count = manager_.list().size();
  if (count > 0 && !force_kill) {
    throw Error("could not reload controller libraries: found " + std::to_string(count) +
                " controllers loaded, expected none or force_kill");
  }
  topics_.clear();
  manager_.unload_all();
}

}  // namespace ardee::node
