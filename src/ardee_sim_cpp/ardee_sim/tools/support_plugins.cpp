// SPDX-License-Identifier: MIT
// Makes each plugin of the registry once, on a small robot, and writes down what it asked for.
#include <algorithm>
#include <map>
#include <sstream>
#include <stdexcept>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "ardee_sim/tools/support_markdown.h"

namespace ardee {
namespace {

constexpr const char* kMessages[] = {
    "sensor_msgs/LaserScan",        "nav_msgs/Odometry",         "tf2_msgs/TFMessage",
    "sensor_msgs/JointState",       "sensor_msgs/Imu",           "sensor_msgs/NavSatFix",
    "geometry_msgs/Vector3Stamped", "sensor_msgs/MagneticField", "ardee_msgs/Encoder",
    "ardee_msgs/Battery",           "sensor_msgs/BatteryState",  "sensor_msgs/Range",
    "sensor_msgs/PointCloud2",      "sensor_msgs/PointCloud",    "sensor_msgs/Image",
    "sensor_msgs/CameraInfo",       "ardee_msgs/GpsQuality",     "visualization_msgs/MarkerArray"};
static_assert(std::size(kMessages) == std::variant_size_v<Reading>, "a message a kind of reading");

/// What plugins that cannot do without a key are given.
const std::map<std::string, std::string>& needed() {
  static const std::map<std::string, std::string> values{
      {"joint", "left_joint"}, {"joint_handle", "left_joint"}, {"jointName", "left_joint"},
      {"bodyName", "base"},    {"frameName", "base"},          {"topicName", "topic"}};
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
  for (const char* name : {"left_joint", "right_joint", "left_front_joint", "right_front_joint",
                           "left_rear_joint", "right_rear_joint"}) {
    joints += wheel(name);
  }
  const std::string sensor =
      "<sensor name='sensor' type='ray'><ray><scan><horizontal><samples>4</samples></horizontal>"
      "</scan><range><min>0.1</min><max>10</max></range></ray><camera name='left'><image>"
      "<width>4</width><height>4</height></image></camera>" +
      plugin + "</sensor>";
  return "<sdf version='1.6'><model name='robot'><link name='base'>" + (in_sensor ? sensor : "") +
         "</link>" + joints + (in_sensor ? "" : plugin) + "</model></sdf>";
}

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ", ") + part;
  return all;
}

/// One plugin of the registry, made.
class MadePlugin {
 public:
  MadePlugin(const std::string& file, bool in_sensor) : file_(file), in_sensor_(in_sensor) {
    while (!make()) add_needed();
  }

  void write(std::ostringstream& page) const {
    page << "### `" << file_ << "`\n\n" << (in_sensor_ ? "Of a sensor. " : "Of a model. ");
    write_ports(page);
    std::vector<std::string> ignored;
    std::string rows;
    for (const AskedKey& key : keys_->keys()) {
      if (key.is_ignored) {
        ignored.push_back("`" + key.name + "`");
        continue;
      }
      const std::string fallback = key.is_required        ? "required"
                                   : key.fallback.empty() ? ""
                                                          : "`" + key.fallback + "`";
      rows += "| `" + key.name + "` | " + key.kind + " | " + fallback + " |\n";
    }
    page << "\n\n| key | | default |\n|---|---|---|\n" << rows << "\n";
    if (!ignored.empty()) page << "Nothing to do: " << joined(ignored) << ".\n\n";
  }

 private:
  bool make() {
    std::string given;
    for (const auto& [key, value] : given_) given += "<" + key + ">" + value + "</" + key + ">";
    const std::string plugin =
        "<plugin name='made' filename='" + file_ + "'>" + given + "</plugin>";
    problem_.clear();
    const LogSink sink = [this](LogLevel level, const std::string& text) {
      if (level == LogLevel::kError) problem_ = text;
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

  void add_needed() {
    for (const AskedKey& key : keys_->keys()) {
      const auto value = needed().find(key.name);
      if (key.is_required && value != needed().end() && given_.insert(*value).second) return;
    }
    throw std::logic_error(file_ + " is not made: " + problem_);
  }

  void write_ports(std::ostringstream& page) const {
    std::vector<std::string> out, in, calls;
    for (const Output& output : device_->outputs()) {
      out.push_back("`" + output.topic + "` (" + kMessages[output.kind] + ")");
    }
    for (const Input& input : device_->inputs()) {
      in.push_back("`" + input.topic + "` (geometry_msgs/Twist)");
    }
    for (const NumberInput& input : device_->number_inputs()) {
      in.push_back("`" + input.topic + "` (std_msgs/Float64)");
    }
    for (const Trigger& trigger : device_->triggers()) {
      in.push_back("`" + trigger.topic + "` (std_msgs/Empty)");
    }
    for (const Service& service : device_->services()) calls.push_back("`" + service.name + "`");
    for (const Tuning& tuning : device_->tunings()) {
      calls.push_back("`" + tuning.name + "` (dynamic_reconfigure)");
    }
    if (!out.empty()) page << "Publishes " << joined(out) << ". ";
    if (!in.empty()) page << "Listens to " << joined(in) << ". ";
    if (!calls.empty()) page << "Serves " << joined(calls) << ".";
  }

  std::string file_;
  bool in_sensor_;
  std::map<std::string, std::string> given_;
  std::string problem_;
  std::shared_ptr<KeyLog> keys_;
  std::unique_ptr<Simulation> simulation_;
  Device* device_ = nullptr;
};

}  // namespace

std::string plugins_in_markdown() {
  std::ostringstream page;
  page << "## Plugins\n\nBy the file that a `<plugin>` names, with a path and `lib` and `.so` or "
          "without. Another name is one warning that lists these, and\nthe plugin is left out. A "
          "key "
          "that is not in a plugin's table is one warning. Keys of what a plugin does only on "
          "demand "
          "are in\n[devices](../src/ardee_sim_cpp/ardee_sim/devices/README.md). Topics are those "
          "without any keys; names in them are those of a\nrobot without a namespace.\n\n";
  const Registry registry = builtin_registry();
  for (const std::string& file : registry.model_plugin_files()) MadePlugin(file, false).write(page);
  for (const std::string& file : registry.sensor_plugin_files()) MadePlugin(file, true).write(page);
  return page.str();
}

}  // namespace ardee
