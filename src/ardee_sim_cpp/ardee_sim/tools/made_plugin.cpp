// SPDX-License-Identifier: MIT
#include "ardee_sim/tools/made_plugin.h"

#include <stdexcept>

#include "ardee_sim/readers/loader.h"

namespace ardee {
namespace {

/// Values of the keys that plugins require.
const std::map<std::string, std::string>& needed() {
  static const std::map<std::string, std::string> values{
      {"joint", "left_joint"},     {"mimicJoint", "right_joint"}, {"joint_handle", "left_joint"},
      {"jointName", "left_joint"}, {"bodyName", "base"},          {"frameName", "base"},
      {"topicName", "topic"}};
  return values;
}

std::string wheel(const std::string& joint) {
  return "<link name='" + joint + "_wheel'/><joint name='" + joint +
         "' type='revolute'><parent>base</parent><child>" + joint +
         "_wheel</child><axis><xyz>0 1 0</xyz></axis></joint>";
}

/// A robot with all joints that drives expect, and one plugin, in a <sensor> of all kinds or not.
std::string robot_with(const std::string& plugin, bool in_sensor) {
  std::string joints;
  for (const char* name :
       {"left_joint", "right_joint", "left_front_joint", "right_front_joint", "left_rear_joint",
        "right_rear_joint", "front_steering_joint", "front_wheel_joint", "left_rear_wheel_joint",
        "right_rear_wheel_joint"}) {
    joints += wheel(name);
  }
  const std::string sensor =
      "<sensor name='sensor' type='ray'><ray><scan><horizontal><samples>4</samples></horizontal>"
      "</scan><range><min>0.1</min><max>10</max></range></ray><camera name='left'><image>"
      "<width>4</width><height>4</height></image></camera><contact><collision>skin</collision>"
      "</contact>" +
      plugin + "</sensor>";
  return "<sdf version='1.6'><model name='robot'><link name='base'>"
         "<collision name='skin'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
         "</collision>" +
         (in_sensor ? sensor : "") + "</link>" + joints + (in_sensor ? "" : plugin) +
         "</model></sdf>";
}

}  // namespace

MadePlugin::MadePlugin(const std::string& file, bool in_sensor, const std::string& more)
    : file_(file), in_sensor_(in_sensor) {
  while (!make(more)) add_needed();
}

bool MadePlugin::make(const std::string& more) {
  std::string given;
  for (const auto& [key, value] : given_) given += "<" + key + ">" + value + "</" + key + ">";
  const std::string plugin =
      "<plugin name='made' filename='" + file_ + "'>" + given + more + "</plugin>";
  problem_.clear();
  warnings_.clear();
  const LogSink sink = [this](LogLevel level, const std::string& text) {
    if (level == LogLevel::kError) problem_ = text;
    if (level == LogLevel::kWarning) warnings_.push_back(text);
  };
  Loader loader(ResourceLocator{}, Log(sink));
  Model model = *loader.load_model_text(robot_with(plugin, in_sensor_), "robot");
  keys_ = std::make_shared<KeyLog>();
  auto& plugins = in_sensor_ ? model.links.at(0).sensors.at(0).plugins : model.plugins;
  plugins.at(0).element.key_log = keys_;
  SpawnRequest request;
  request.name = "robot";
  request.model = std::make_shared<const Model>(std::move(model));
  simulation_ = std::make_unique<Simulation>(World{}, SimulationOptions{}, sink);
  try {
    device_ = nullptr;
    Entity& robot = simulation_->spawn(request);
    if (!robot.devices.empty()) device_ = robot.devices.front().get();
  } catch (const Error& error) {
    problem_ = error.what();
  }
  return device_ != nullptr;
}

void MadePlugin::add_needed() {
  for (const AskedKey& key : keys_->keys()) {
    const auto value = needed().find(key.name);
    if (key.is_required && value != needed().end() && given_.insert(*value).second) return;
  }
  throw std::logic_error(file_ + " is not made: " + problem_);
}

}  // namespace ardee
