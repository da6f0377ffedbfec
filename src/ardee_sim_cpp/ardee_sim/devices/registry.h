// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/device.h"

namespace ardee {

/// Maps the plugin file names that users write to the devices that do their work.
class Registry {
 public:
  using ModelPlugin =
      std::function<std::unique_ptr<Device>(const PluginDescription&, DeviceContext&)>;
  using SensorPlugin = std::function<std::unique_ptr<Device>(
      const SensorDescription&, const PluginDescription&, std::size_t link, DeviceContext&)>;

  void add_model_plugin(const std::string& filename, ModelPlugin make);
  void add_sensor_plugin(const std::string& filename, SensorPlugin make);

  /// A device for each plugin of the robot and of its links' sensors, in the order of the
  /// description. A plugin of unknown file name is a warning that lists the known ones; a bad value
  /// inside a known one is an Error.
  std::vector<std::unique_ptr<Device>> make_devices(DeviceContext& context) const;

 private:
  std::string known_names() const;

  std::map<std::string, ModelPlugin> model_plugins_;
  std::map<std::string, SensorPlugin> sensor_plugins_;
};

/// All that ARDEE has, a line each.
Registry builtin_registry();

}  // namespace ardee
