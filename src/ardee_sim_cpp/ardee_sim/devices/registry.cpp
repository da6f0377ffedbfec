// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/registry.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "ardee_sim/core/nearest_names.h"
#include "ardee_sim/devices/camera_sensor.h"
#include "ardee_sim/devices/gps.h"
#include "ardee_sim/devices/skid_steer_drive.h"

namespace ardee::devices {
namespace {

/// "path/libx.so", "libx.so" and "x" name the same plugin.
std::string stem(const std::string& filename) {
  std::string text = filename.substr(filename.find_last_of('/') + 1);
  const std::string ending = ".so";
  if (text.size() > ending.size() && text.compare(text.size() - 3, 3, ending) == 0) {
    text.resize(text.size() - ending.size());
  }
  return text.rfind("lib", 0) == 0 ? text.substr(3) : text;
}

/// Returns the result of `make`; if that throws, nothing, with an error in the log. `what` is
/// "sensor" or "plugin".
template <typename Make>
std::unique_ptr<Device> made_or_left_out(const Make& make, const PluginDescription& plugin,
                                         const char* what, const std::string& name, Log& log) {
  try {
    return make();
  } catch (const Error& error) {
    log.error(plugin.element.source.to_string() + ": " + what + " '" + name + "' (" +
              plugin.filename + ") is left out: " + error.what());
    return nullptr;
  }
}

/// Content of an element without its place in the file.
std::string text_of(const Element& element) {
  std::string text = "<" + element.name;
  for (const auto& [name, value] : element.attributes) text += " " + name + "='" + value + "'";
  text += ">" + element.text;
  for (const Element& child : element.children) text += text_of(child);
  return text + "</" + element.name + ">";
}

/// The plugin with the registry's names of file and keys.
PluginDescription renamed(PluginDescription plugin, const PluginAlias& alias) {
  plugin.filename = alias.plugin;
  for (Element& key : plugin.element.children) {
    const auto found = alias.keys.find(key.name);
    if (found != alias.keys.end()) key.name = found->second;
  }
  return plugin;
}

/// As in Gazebo 0 means each step.
void check_update_rate(const SensorDescription& sensor) {
  Parameters(sensor.element).number("update_rate", 0.0, 0.0);
}

template <typename Map, typename Make>
void add(Map& plugins, const std::string& filename, Make make) {
  if (!plugins.emplace(stem(filename), std::move(make)).second) {
    throw std::logic_error("plugin " + filename + " is registered twice");
  }
}

/// A sensor's factory with the scene that the plugin's name defines.
template <typename Make, typename What>
Registry::SensorPlugin with(Make make, const What& what) {
  return [make, what](const SensorDescription& sensor, Parameters& keys, std::size_t link,
                      DeviceContext& context) { return make(sensor, keys, link, what, context); };
}

}  // namespace

/// A plugin of a model or of one of its sensors.
struct Registry::Candidate {
  std::string name;
  const PluginDescription* plugin = nullptr;
  const SensorDescription* sensor = nullptr;  // null: of the model
  std::size_t link = 0;                       // of the sensor
};

std::vector<Registry::Candidate> Registry::candidates_of(const Model& model) {
  std::vector<Candidate> found;
  for (const PluginDescription& plugin : model.plugins) found.push_back({plugin.name, &plugin});
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    for (const SensorDescription& sensor : model.links[link].sensors) {
      for (const PluginDescription& plugin : sensor.plugins) {
        found.push_back({sensor.name, &plugin, &sensor, link});
      }
    }
  }
  const auto key = [&model](const Candidate& each) {
    return std::make_tuple(
        each.name, each.plugin->filename, each.sensor ? model.links[each.link].name : "",
        text_of(each.plugin->element) + (each.sensor ? text_of(each.sensor->element) : ""));
  };
  std::multimap<decltype(key(Candidate{})), Candidate> sorted;  // keeps the order of equal keys
  for (Candidate& each : found) sorted.emplace(key(each), each);
  std::transform(sorted.begin(), sorted.end(), found.begin(),
                 [](const auto& entry) { return entry.second; });
  return found;
}

std::string Registry::nearest_plugins(const std::string& filename) const {
  std::vector<std::string> known = model_plugin_files();
  for (const std::string& file : sensor_plugin_files()) known.push_back(file);
  for (const auto& [name, alias] : aliases_) known.push_back(alias.filename);
  return nearest_names("lib" + stem(filename) + ".so", known);
}

void Registry::add_alias(const PluginAlias& alias) {
  const auto is_known = [this](const std::string& name) {
    return model_plugins_.count(name) != 0 || sensor_plugins_.count(name) != 0;
  };
  const std::string name = stem(alias.filename);
  const std::string problem = "plugin alias '" + alias.filename + "': found ";
  if (!is_known(stem(alias.plugin))) {
    throw Error(problem + "plugin '" + alias.plugin +
                "', expected one in docs/support.md; nearest: " + nearest_plugins(alias.plugin));
  }
  if (name.empty() || is_known(name) || !aliases_.emplace(name, alias).second) {
    throw Error(problem + "this file name, expected one that is not empty and not taken");
  }
}

void Registry::add_model_plugin(const std::string& filename, ModelPlugin make) {
  add(model_plugins_, filename, ModelMaker{std::move(make), false});
}

void Registry::add_model_sensor(const std::string& filename, ModelPlugin make) {
  add(model_plugins_, filename, ModelMaker{std::move(make), true});
}

void Registry::add_sensor_plugin(const std::string& filename, SensorPlugin make) {
  add(sensor_plugins_, filename, std::move(make));
}

std::unique_ptr<Device> Registry::make(const Candidate& candidate, DeviceContext& context) const {
  const auto alias = aliases_.find(stem(candidate.plugin->filename));
  const PluginDescription plugin =
      alias == aliases_.end() ? *candidate.plugin : renamed(*candidate.plugin, alias->second);
  const std::string name = stem(plugin.filename);
  const auto of_model = model_plugins_.find(name);
  const auto of_sensor = sensor_plugins_.find(name);
  const bool found =
      candidate.sensor ? of_sensor != sensor_plugins_.end() : of_model != model_plugins_.end();
  if (!found) {
    const std::string expected =
        of_sensor != sensor_plugins_.end() ? "it within a <sensor>"
        : of_model != model_plugins_.end()
            ? "it outside of <sensor>"
            : "one in docs/support.md; nearest: " + nearest_plugins(plugin.filename);
    context.log.warn(plugin.element.source.to_string() + ": found plugin '" + plugin.filename +
                     "', expected " + expected + "; it is left out");
    return nullptr;
  }
  const auto make = [&] {
    Parameters keys(plugin.element);
    if (candidate.sensor) check_update_rate(*candidate.sensor);
    auto device = candidate.sensor
                      ? of_sensor->second(*candidate.sensor, keys, candidate.link, context)
                      : of_model->second.make(plugin, keys, context);
    keys.finish(context.log);
    return device;
  };
  // A static model keeps the devices that do not need motion.
  const bool may_fail =
      candidate.sensor || of_model->second.is_sensor || !context.robot.is_dynamic();
  const char* what = candidate.sensor ? "sensor" : "plugin";
  auto device =
      may_fail ? made_or_left_out(make, plugin, what, candidate.name, context.log) : make();
  if (device) device->set_optional(may_fail);
  return device;
}

std::vector<std::unique_ptr<Device>> Registry::make_devices(const DeviceContext& robot) const {
  std::vector<std::unique_ptr<Device>> devices;
  std::map<std::string, int> namesakes;
  for (const Candidate& candidate : candidates_of(robot.robot.model())) {
    DeviceContext context = robot;
    context.scope = candidate.plugin->scope;
    // A device's errors follow from seed and name: devices of equal name get different seeds.
    const int before = namesakes[candidate.name]++;
    if (before > 0) context.seed = stream_key(robot.seed, "namesake " + std::to_string(before));
    if (auto device = make(candidate, context)) devices.push_back(std::move(device));
  }
  return devices;
}

Registry builtin_registry() {
  using raycast::SceneKind;
  Registry registry;
  registry.add_model_plugin("libardee_ros_joint_position.so", make_joint_position);
  registry.add_model_plugin("libroboticsgroup_gazebo_mimic_joint_plugin.so", make_mimic_joint);
  registry.add_model_plugin("libgazebo_mimic_joint_plugin.so", make_mimic_joint);
  registry.add_model_plugin("libardee_ros_skid_steer_drive.so", SkidSteerDrive::make_with_encoders);
  registry.add_model_plugin("libgazebo_ros_diff_drive.so", make_diff_drive);
  registry.add_model_plugin("libgazebo_ros_force.so", make_link_push);
  registry.add_model_plugin("libgazebo_ros_planar_move.so", make_planar_move);
  registry.add_model_plugin("libgazebo_ros_skid_steer_drive.so", SkidSteerDrive::make);
  registry.add_model_plugin("libgazebo_ros_tricycle_drive.so", make_tricycle_drive);
  registry.add_model_plugin("libTorsionalSpringPlugin.so", make_torsional_spring);
  registry.add_model_sensor("libardee_ros_battery.so", make_battery);
  registry.add_model_sensor("libardee_ros_encoder.so", make_encoder);
  registry.add_model_sensor("libgazebo_ros_f3d.so", make_link_force);
  registry.add_model_sensor("libgazebo_ros_ft_sensor.so", make_force_torque);
  registry.add_model_sensor("libgazebo_ros_gps_with_dropout.so", make_gps_with_dropout);
  registry.add_model_sensor("libgazebo_ros_imu.so", make_imu_on_model);
  registry.add_model_sensor("libgazebo_ros_joint_state_publisher.so", make_joint_state_publisher);
  registry.add_model_sensor("libgazebo_ros_p3d.so", make_ground_truth);
  registry.add_model_sensor("libhector_gazebo_ros_gps.so", Gps::make);
  registry.add_model_sensor("libhector_gazebo_ros_imu.so", make_hector_imu);
  registry.add_model_sensor("libhector_gazebo_ros_magnetic.so", make_magnetometer);
  registry.add_sensor_plugin("libgazebo_ros_block_laser.so", make_block_lidar);
  registry.add_sensor_plugin("libgazebo_ros_bumper.so", make_bumper);
  registry.add_sensor_plugin("libgazebo_ros_camera.so", with(CameraSensor::make, CameraPlugin{}));
  registry.add_sensor_plugin("libgazebo_ros_depth_camera.so",
                             with(CameraSensor::make, CameraPlugin{CameraKind::kDepth}));
  registry.add_sensor_plugin("libgazebo_ros_multicamera.so",
                             with(CameraSensor::make, CameraPlugin{CameraKind::kColor, true}));
  registry.add_sensor_plugin("libgazebo_ros_openni_kinect.so",
                             with(CameraSensor::make, CameraPlugin{CameraKind::kOpenni}));
  registry.add_sensor_plugin(
      "libgazebo_ros_triggered_camera.so",
      with(CameraSensor::make, CameraPlugin{CameraKind::kColor, false, true}));
  registry.add_sensor_plugin(
      "libgazebo_ros_triggered_multicamera.so",
      with(CameraSensor::make, CameraPlugin{CameraKind::kColor, true, true}));
  registry.add_sensor_plugin("libgazebo_ros_gpu_laser.so", with(make_lidar, SceneKind::kVisual));
  registry.add_sensor_plugin("libgazebo_ros_imu_sensor.so", make_imu_on_sensor);
  registry.add_sensor_plugin("libgazebo_ros_laser.so", with(make_lidar, SceneKind::kCollision));
  registry.add_sensor_plugin("libgazebo_ros_range.so", make_range_finder);
  registry.add_sensor_plugin("libgazebo_ros_velodyne_gpu_laser.so",
                             with(make_velodyne_lidar, SceneKind::kVisual));
  registry.add_sensor_plugin("libgazebo_ros_velodyne_laser.so",
                             with(make_velodyne_lidar, SceneKind::kCollision));
  registry.add_sensor_plugin("libhector_gazebo_ros_sonar.so", make_sonar);
  for (const PluginAlias& alias : builtin_aliases()) registry.add_alias(alias);
  return registry;
}

}  // namespace ardee::devices
