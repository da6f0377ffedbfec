// SPDX-License-Identifier: MIT Lists the keys that each plugin of the registry reads at
// construction.
#include <iterator>
#include <sstream>

#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/readers/gz_systems.h"
#include "ardee_sim/simulation/plugins.h"
#include "ardee_sim/tools/made_plugin.h"
#include "ardee_sim/tools/support_markdown.h"

namespace ardee {
namespace {

constexpr const char* kMessages[] = {"sensor_msgs/LaserScan",
                                     "nav_msgs/Odometry",
                                     "tf2_msgs/TFMessage",
                                     "sensor_msgs/JointState",
                                     "sensor_msgs/Imu",
                                     "sensor_msgs/NavSatFix",
                                     "geometry_msgs/Vector3Stamped",
                                     "sensor_msgs/MagneticField",
                                     "ardee_msgs/Encoder",
                                     "ardee_msgs/Battery",
                                     "sensor_msgs/BatteryState",
                                     "sensor_msgs/Range",
                                     "sensor_msgs/PointCloud2",
                                     "sensor_msgs/PointCloud",
                                     "sensor_msgs/Image",
                                     "sensor_msgs/CameraInfo",
                                     "ardee_msgs/GpsQuality",
                                     "visualization_msgs/MarkerArray",
                                     "geometry_msgs/TwistStamped",
                                     "control_msgs/JointControllerState",
                                     "control_msgs/JointTrajectoryControllerState",
                                     "four_wheel_steering_msgs/FourWheelSteeringStamped",
                                     "gazebo_msgs/ContactsState",
                                     "geometry_msgs/WrenchStamped"};
static_assert(std::size(kMessages) == std::variant_size_v<devices::Reading>,
              "a message a kind of reading");

constexpr const char* kCommandMessages[] = {  // in the order of Command
    "std_msgs/Empty",
    "geometry_msgs/Twist",
    "std_msgs/Float64",
    "std_msgs/Bool",
    "std_msgs/Float64MultiArray",
    "four_wheel_steering_msgs/FourWheelSteering",
    "trajectory_msgs/JointTrajectory",
    "geometry_msgs/Wrench"};
static_assert(std::size(kCommandMessages) == std::variant_size_v<devices::Command>,
              "a message a kind of command");

std::string joined(const std::vector<std::string>& parts) {
  std::string all;
  for (const std::string& part : parts) all += (all.empty() ? "" : ", ") + part;
  return all;
}

void write_ports(devices::Device& device, std::ostringstream& page) {
  std::vector<std::string> out, in, calls;
  device.ports().visit(
      [&](const devices::Output& output) {
        out.push_back("`" + output.topic + "` (" + kMessages[output.kind] + ")");
      },
      [&](const devices::Input& input) {
        in.push_back("`" + input.topic + "` (" + kCommandMessages[input.kind] + ")");
      },
      [&](const devices::Service& service) { calls.push_back("`" + service.name + "`"); },
      [&](const devices::ParameterGroup& tuning) {
        calls.push_back("`" + tuning.name + "` (dynamic_reconfigure)");
      },
      [&](const devices::Action& action) {
        std::visit([&](const auto& each) { calls.push_back("`" + each.name + "` (actionlib)"); },
                   action);
      });
  if (!out.empty()) page << " Publishes " << joined(out) << ".";
  if (!in.empty()) page << " Listens to " << joined(in) << ".";
  if (!calls.empty()) page << " Serves " << joined(calls) << ".";
}

void write_keys(const KeyLog& keys, std::ostringstream& page) {
  std::vector<std::string> ignored;
  std::string rows;
  for (const AskedKey& key : keys.keys()) {
    if (key.is_ignored) {
      ignored.push_back("`" + key.name + "`");
      continue;
    }
    std::string fallback = key.is_required ? "required" : "";
    if (!key.fallback.empty()) fallback = "`" + key.fallback + "`";
    rows += "| `" + key.name + "` | " + key.kind + " | " + fallback + " |\n";
  }
  page << "| key | | default |\n|---|---|---|\n" << rows << "\n";
  if (!ignored.empty()) page << "Nothing to do: " << joined(ignored) << ".\n\n";
}

void write_plugin(const std::string& file, bool in_sensor, std::ostringstream& page) {
  const MadePlugin made(file, in_sensor);
  page << "### `" << file << "`\n\n" << (in_sensor ? "Of a sensor." : "Of a model.");
  write_ports(made.device(), page);
  page << "\n\n";
  write_keys(made.keys(), page);
}

void write_aliases(std::ostringstream& page) {
  page << "### Plugins of other names\n\nThese rows of "
          "`src/ardee_sim_cpp/config/plugin_aliases.yaml` "
          "do the work of another plugin's name, with keys of other names where any are\nlisted. A "
          "list `~plugin_aliases` of the simulator node adds to them: `filename`, `plugin` (one of "
          "the above), `keys` (their name: ours).\n`librealsense_gazebo_plugin.so` of a model is "
          "read as a camera plugin in each of its four sensors.\n\n"
          "| file | plugin | keys |\n|---|---|---|\n";
  for (const devices::PluginAlias& alias : devices::builtin_aliases()) {
    page << "| `" << alias.filename << "` | `" << alias.plugin << "` | ";
    for (const auto& [theirs, ours] : alias.keys) page << "`" << theirs << "`: `" << ours << "` ";
    page << "|\n";
  }
  page << "\n";
}

void write_systems(std::ostringstream& page) {
  page
      << "### Systems and sensors of newer Gazebo\n\n`gz-sim-NAME-system` and "
         "`ignition-gazebo-NAME-system` are read as the plugins that do their work; others are one "
         "warning\neach, and are left out. A sensor of type lidar, camera, rgbd_camera, "
         "depth_camera, imu, contact, navsat or magnetometer with a `<topic>`\nneeds no plugin.\n\n"
         "| system | plugin | warning |\n|---|---|---|\n";
  for (const GzCounterpart& each : gz_counterparts()) {
    page << "| `" << each.system << "` | `" << each.plugin << "` | " << each.warning << " |\n";
  }
  std::vector<std::string> settled;
  for (const std::string& system : settled_gz_systems()) settled.push_back("`" + system + "`");
  page << "\nNothing to do: " << joined(settled) << ".\n\n";
}

void write_controllers(std::ostringstream& page) {
  page << "### Controllers of `libgazebo_ros_control.so`\n\nBy the `type` among a controller's "
          "parameters.\n\n";
  for (const auto& [type, make] : control::controller_types()) page << "- `" << type << "`\n";
  page << "\n";
}

}  // namespace

std::string plugins_in_markdown() {
  std::ostringstream page;
  page << "## Plugins\n\nBy the file that a `<plugin>` names, with a path and `lib` and `.so` or "
          "without. Another name is one warning that lists these, and\nthe plugin is left out. A "
          "key "
          "that is not in a plugin's table is one warning. Keys of what a plugin does only on "
          "demand "
          "are in\n[devices](../src/ardee_sim_cpp/ardee_sim/devices/README.md). Topics are those "
          "without any keys; names in them are those of a\nrobot without a namespace. A bad value "
          "in a plugin that publishes leaves that plugin out, with one error; in a drive, a servo\n"
          "or a spring it refuses the robot. Plugins of worlds are left out with a warning "
          "each.\n\n";
  const devices::Registry registry = known_plugins();
  for (const std::string& file : registry.model_plugin_files()) write_plugin(file, false, page);
  for (const std::string& file : registry.sensor_plugin_files()) write_plugin(file, true, page);
  write_controllers(page);
  write_aliases(page);
  write_systems(page);
  return page.str();
}

}  // namespace ardee
