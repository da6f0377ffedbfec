// SPDX-License-Identifier: MIT
#include <ardee_msgs/Step.h>
#include <std_srvs/Empty.h>

#include "ros/conversions.h"
#include "ros/services.h"

namespace ardee::node {
namespace {

void add_verb(ServiceServers& servers, const std::string& name, std::function<void()> verb) {
  servers.add<std_srvs::Empty>(name, name, [verb](const auto&, auto&) {
    verb();
    return std::string();
  });
}

std::string step(ServiceContext& context, std::uint32_t steps, ardee_msgs::StepResponse& response) {
  response.sim_time = to_ros(context.simulation.now_ns());
  const std::uint32_t taken = context.runner.advance(steps);
  response.sim_time = to_ros(context.simulation.now_ns());
  if (taken < steps) {
    throw Error("interrupted after " + std::to_string(taken) + " of " + std::to_string(steps) +
                " steps");
  }
  return "Step: took " + std::to_string(taken) + " steps";
}

}  // namespace

void add_control_services(ServiceServers& servers, ServiceContext& context) {
  Runner& runner = context.runner;
  add_verb(servers, "pause_physics", [&runner] { runner.set_paused(true); });
  add_verb(servers, "unpause_physics", [&runner] { runner.set_paused(false); });
  add_verb(servers, "reset_world", [&runner] { runner.reset_world(); });
  add_verb(servers, "reset_simulation", [&runner] { runner.reset_simulation(); });
  servers.add<ardee_msgs::Step>("/ardee/step", "Step",
                                [&context](const auto& request, auto& response) {
                                  return step(context, request.steps, response);
                                });
}

}  // namespace ardee::node
