// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/plugin_aliases.h"

namespace ardee::devices {

/// Maps the plugin file names that users write to the devices that do their work.
class Registry {
 public:
  /// Keys that a maker does not read are warnings.
  using ModelPlugin = std::function<MakeOnModel>;
  using SensorPlugin = std::function<MakeOnSensor>;

  /// Adds a controller, which the robot requires.
  void add_model_plugin(const std::string& filename, ModelPlugin make);
  /// Adds a sensor that Gazebo attaches to the model (GPS, IMU, encoder, battery, ...).
  void add_model_sensor(const std::string& filename, ModelPlugin make);
  void add_sensor_plugin(const std::string& filename, SensorPlugin make);

  /// Adds another name of a plugin. Throws Error for an unknown plugin, or a name that is taken.
  void add_alias(const PluginAlias& alias);

  /// Makes a device for each plugin of the robot and of its links' sensors, in the order of their
  /// names, in which they act; the order of the description has no effect. A plugin of unknown file
  /// name is a warning that says where the known ones are listed. An invalid value in a controller
  /// is an Error; a sensor with one is left out, with an error in the log.
  std::vector<std::unique_ptr<Device>> make_devices(const DeviceContext& robot) const;
  /// File names, sorted.
  std::vector<std::string> model_plugin_files() const { return files_of(model_plugins_); }
  std::vector<std::string> sensor_plugin_files() const { return files_of(sensor_plugins_); }

 private:
  struct Candidate;

  static std::vector<Candidate> candidates_of(const Model& model);
  /// The names nearest to an unknown one, for a message.
  std::string nearest_plugins(const std::string& filename) const;
  /// Makes a device; none for a plugin that is unknown or left out.
  std::unique_ptr<Device> make(const Candidate& candidate, DeviceContext& context) const;
  template <typename Plugins>
  static std::vector<std::string> files_of(const Plugins& plugins) {
    std::vector<std::string> files;
    for (const auto& [name, make] : plugins) files.push_back("lib" + name + ".so");
    return files;
  }

  struct ModelMaker {
    ModelPlugin make;
    bool is_sensor = false;
  };
  std::map<std::string, ModelMaker> model_plugins_;
  std::map<std::string, SensorPlugin> sensor_plugins_;
  std::map<std::string, PluginAlias> aliases_;
};

/// All built-in devices, one line each.
Registry builtin_registry();

}  // namespace ardee::devices
