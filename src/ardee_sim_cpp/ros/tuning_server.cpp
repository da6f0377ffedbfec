// SPDX-License-Identifier: MIT
#include "ros/tuning_server.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace ardee::node {
namespace {

using dynamic_reconfigure::Config;

const ros::WallDuration kLook(0.2);

/// The numbers that `value` gives for the parameters, as one message.
Config config_of(const devices::ParameterGroup& tuning,
                 const std::function<double(const devices::TunableParameter&)>& value) {
  Config config;
  for (const devices::TunableParameter& parameter : tuning.parameters) {
    if (parameter.type == devices::TunableParameter::Type::kBool) {
      auto& kept = config.bools.emplace_back();
      kept.name = parameter.name;
      kept.value = value(parameter) != 0.0;
    } else if (parameter.type == devices::TunableParameter::Type::kInt) {
      auto& kept = config.ints.emplace_back();
      kept.name = parameter.name;
      kept.value = static_cast<int>(std::lround(value(parameter)));
    } else {
      auto& kept = config.doubles.emplace_back();
      kept.name = parameter.name;
      kept.value = value(parameter);
    }
  }
  auto& group = config.groups.emplace_back();
  group.name = "Default";
  group.state = true;
  return config;
}

const char* type_name(devices::TunableParameter::Type type) {
  if (type == devices::TunableParameter::Type::kBool) return "bool";
  return type == devices::TunableParameter::Type::kInt ? "int" : "double";
}

dynamic_reconfigure::ConfigDescription describe(const devices::ParameterGroup& tuning) {
  dynamic_reconfigure::ConfigDescription description;
  auto& group = description.groups.emplace_back();
  group.name = "Default";
  for (const devices::TunableParameter& parameter : tuning.parameters) {
    auto& kept = group.parameters.emplace_back();
    kept.name = parameter.name;
    kept.type = type_name(parameter.type);
    kept.description = parameter.description;
  }
  description.min =
      config_of(tuning, [](const devices::TunableParameter& each) { return each.low; });
  description.max =
      config_of(tuning, [](const devices::TunableParameter& each) { return each.high; });
  description.dflt =
      config_of(tuning, [](const devices::TunableParameter& each) { return each.initial; });
  return description;
}

void set_alone(const devices::ParameterGroup& tuning, const std::string& name, double value) {
  const auto found =
      std::find_if(tuning.parameters.begin(), tuning.parameters.end(),
                   [&name](const devices::TunableParameter& each) { return each.name == name; });
  if (found == tuning.parameters.end() || !std::isfinite(value)) {
    ROS_ERROR_STREAM(tuning.name << ": found '" << name << "' = " << value
                                 << ", expected a finite value of a known parameter; ignored");
    return;
  }
  found->set(std::clamp(value, found->low, found->high));
}

}  // namespace

TuningServer::TuningServer(ros::NodeHandle& node, const devices::ParameterGroup& tuning)
    : TuningServer(node, tuning, [&tuning](const Values& values) {
        for (const auto& [name, value] : values) set_alone(tuning, name, value);
      }) {}

TuningServer::TuningServer(ros::NodeHandle& node, const devices::ParameterGroup& tuning,
                           std::function<void(const Values&)> set)
    : tuning_(tuning),
      set_(std::move(set)),
      descriptions_(node.advertise<dynamic_reconfigure::ConfigDescription>(
          tuning.name + "/parameter_descriptions", 1, true)),
      updates_(node.advertise<Config>(tuning.name + "/parameter_updates", 1, true)),
      service_(node.advertiseService(service_of(tuning), &TuningServer::serve, this)) {
  descriptions_.publish(describe(tuning_));
  publish();
  timer_ = node.createWallTimer(kLook, [this](const ros::WallTimerEvent&) {
    if (numbers() != published_) publish();
  });
}

void TuningServer::publish() {
  published_ = numbers();
  updates_.publish(current());
}

std::vector<double> TuningServer::numbers() const {
  std::vector<double> made;
  for (const devices::TunableParameter& each : tuning_.parameters) made.push_back(each.get());
  return made;
}

Config TuningServer::current() const {
  return config_of(tuning_, [](const devices::TunableParameter& each) { return each.get(); });
}

bool TuningServer::serve(dynamic_reconfigure::Reconfigure::Request& request,
                         dynamic_reconfigure::Reconfigure::Response& response) {
  Values values;
  for (const auto& each : request.config.doubles) values.emplace_back(each.name, each.value);
  for (const auto& each : request.config.ints) values.emplace_back(each.name, each.value);
  for (const auto& each : request.config.bools) values.emplace_back(each.name, each.value);
  try {
    set_(values);
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM(tuning_.name << ": " << error.what() << "; nothing is changed");
  }
  response.config = current();
  publish();
  return true;
}

}  // namespace ardee::node
