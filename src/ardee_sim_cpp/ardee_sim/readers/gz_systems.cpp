// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/gz_systems.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/gz_sensors.h"

namespace ardee {
namespace {

/// A key of a system, the corresponding key of the stock plugin, and a factor for numbers.
struct Key {
  const char* gz;
  const char* ours;
  double factor = 1.0;
};

/// A system, the stock plugin that does its work, and the keys that the plugin needs for equal
/// behaviour.
struct System {
  const char* name;
  const char* plugin;
  std::vector<Key> keys;
  std::vector<std::pair<const char*, const char*>> added;  // unless the system says otherwise
  const char* warning = "";
};

const std::vector<System>& systems() {
  static const std::vector<System> table{
      {"diff-drive",
       "libgazebo_ros_diff_drive.so",
       {{"wheel_separation", "wheelSeparation"},
        {"wheel_radius", "wheelDiameter", 2.0},
        {"topic", "commandTopic"},
        {"odom_topic", "odometryTopic"},
        {"frame_id", "odometryFrame"},
        {"child_frame_id", "robotBaseFrame"},
        {"odom_publish_frequency", "updateRate"}},
       {{"updateRate", "50"}, {"legacyMode", "false"}, {"odometrySource", "encoder"}}},
      {"mecanum-drive",
       "libgazebo_ros_planar_move.so",
       {{"topic", "commandTopic"},
        {"odom_topic", "odometryTopic"},
        {"frame_id", "odometryFrame"},
        {"child_frame_id", "robotBaseFrame"},
        {"odom_publish_frequency", "odometryRate"},
        {"front_left_joint", ""},
        {"front_right_joint", ""},
        {"back_left_joint", ""},
        {"back_right_joint", ""},
        {"wheel_separation", ""},
        {"wheelbase", ""},
        {"wheel_radius", ""}},
       {{"odometryRate", "50"}},
       "the robot is moved as a whole, its wheels are not driven"},
      {"joint-state-publisher",
       "libgazebo_ros_joint_state_publisher.so",
       {{"update_rate", "updateRate"}},
       {{"robotNamespace", ""}}},
      {"odometry-publisher",
       "libgazebo_ros_p3d.so",
       {{"odom_topic", "topicName"},
        {"odom_publish_frequency", "updateRate"},
        {"gaussian_noise", "gaussianNoise"},
        {"robot_base_frame", ""},
        {"odom_frame", ""},
        {"dimensions", ""}},
       {{"topicName", "odom"},
        {"updateRate", "50"},
        {"frameName", "world"},
        {"local_twist", "true"}},
       "the odometry is that of the true pose in the world"},
      {"joint-position-controller",
       "libardee_ros_joint_position.so",
       {{"joint_name", "joint"}, {"topic", "commandTopic"}, {"cmd_max", "maxEffort"}},
       {}}};
  return table;
}

/// "libgz-sim-diff-drive-system.so", "gz-sim7-diff-drive-system" and
/// "ignition-gazebo-diff-drive-system" name diff-drive; empty: no system of newer Gazebo.
std::string system_name(const std::string& filename) {
  std::string name = filename.substr(filename.find_last_of('/') + 1);
  if (name.rfind("lib", 0) == 0) name.erase(0, 3);
  if (const std::size_t ending = name.find(".so"); ending != std::string::npos) name.resize(ending);
  for (const std::string prefix : {"gz-sim", "ignition-gazebo"}) {
    if (name.rfind(prefix, 0) != 0) continue;
    const std::size_t dash = name.find_first_not_of("0123456789", prefix.size());
    if (dash == std::string::npos || name[dash] != '-') continue;
    name.erase(0, dash + 1);
    const std::size_t ending = name.rfind("-system");
    return ending == std::string::npos ? name : name.substr(0, ending);
  }
  return "";
}

std::string scaled(const Element& key, double factor) {
  if (factor == 1.0) return key.text;
  std::ostringstream text;
  text.precision(17);
  text << factor * parse_number(key.text, key.source);
  return text.str();
}

PluginDescription translate(const PluginDescription& given, const System& system) {
  PluginDescription made = given;
  made.filename = system.plugin;
  made.element.children.clear();
  for (Element child : given.element.children) {
    const auto rule = std::find_if(system.keys.begin(), system.keys.end(),
                                   [&](const Key& key) { return child.name == key.gz; });
    if (rule != system.keys.end()) {
      child.text = scaled(child, rule->factor);
      child.name = rule->ours;
    }
    if (!child.name.empty()) made.element.children.push_back(std::move(child));
  }
  for (const auto& [name, text] : system.added) {
    if (!made.element.child(name)) add_key(made, name, text);
  }
  return made;
}

std::vector<Element> take_all(PluginDescription& plugin, const std::string& name) {
  std::vector<Element> taken;
  std::vector<Element> left;
  for (Element& child : plugin.element.children) {
    (child.name == name ? taken : left).push_back(std::move(child));
  }
  plugin.element.children = std::move(left);
  return taken;
}

/// The least effort of a drive's joints: newer Gazebo's drives have no other limit.
std::string wheel_torque(const Model& model, const std::vector<Element>& joints) {
  double least = 1e6;
  for (const Element& name : joints) {
    const Joint* joint = model.find_joint(name.text);
    if (joint) least = std::min(least, joint->axis.effort);
  }
  std::ostringstream text;
  text << least;
  return text.str();
}

/// One stock drive for each pair of wheels, all with one command; the first publishes the odometry.
void add_diff_drives(PluginDescription drive, const Model& model,
                     std::vector<PluginDescription>& made) {
  const std::vector<Element> left = take_all(drive, "left_joint");
  const std::vector<Element> right = take_all(drive, "right_joint");
  if (left.empty() || right.empty()) {
    throw Error(drive.element.source, "found no <left_joint> or no <right_joint>, expected both");
  }
  std::vector<Element> wheels = left;
  wheels.insert(wheels.end(), right.begin(), right.end());
  add_key(drive, "wheelTorque", wheel_torque(model, wheels));
  if (!drive.element.child("robotBaseFrame")) {
    add_key(drive, "robotBaseFrame", model.canonical_link);
  }
  for (std::size_t pair = 0; pair < std::max(left.size(), right.size()); ++pair) {
    PluginDescription each = drive;
    add_key(each, "leftJoint", left[std::min(pair, left.size() - 1)].text);
    add_key(each, "rightJoint", right[std::min(pair, right.size() - 1)].text);
    if (pair > 0) {
      each.name += "_" + std::to_string(pair);
      add_key(each, "publishOdom", "false");
      add_key(each, "publishOdomTF", "false");
    }
    made.push_back(std::move(each));
  }
}

/// The joints that the system names, or all moving joints.
void add_joint_names(const Model& model, PluginDescription& publisher) {
  std::string names;
  for (const Element& joint : take_all(publisher, "joint_name")) names += joint.text + ",";
  if (names.empty()) {
    for (const Joint& joint : model.joints) {
      if (joint.type != JointType::kFixed) names += joint.name + ",";
    }
  }
  add_key(publisher, "jointName", names);
}

void add_body_name(const PluginDescription& given, const Model& model, PluginDescription& made) {
  const Element* frame = given.element.child("robot_base_frame");
  const Link* link = frame ? model.find_link(frame->text) : nullptr;
  add_key(made, "bodyName", link ? link->name : model.canonical_link);
}

void adopt_plugin(const PluginDescription& given, const std::string& name, const Model& model,
                  std::vector<PluginDescription>& made, Log& log) {
  const auto& table = systems();
  const auto system = std::find_if(table.begin(), table.end(),
                                   [&name](const System& each) { return name == each.name; });
  if (system == table.end()) {
    log.warn(given.element.source, "found a system of newer Gazebo that has no counterpart here",
             ": '" + given.filename + "'; it is left out");
    return;
  }
  if (*system->warning != '\0') log.warn(given.element.source, system->warning);
  PluginDescription plugin = translate(given, *system);
  if (name == "diff-drive") {
    add_diff_drives(std::move(plugin), model, made);
    return;
  }
  if (name == "joint-state-publisher") add_joint_names(model, plugin);
  if (name == "odometry-publisher") add_body_name(given, model, plugin);
  made.push_back(std::move(plugin));
}

}  // namespace

std::vector<GzCounterpart> gz_counterparts() {
  std::vector<GzCounterpart> made;
  for (const System& each : systems()) made.push_back({each.name, each.plugin, each.warning});
  return made;
}

const std::set<std::string>& settled_gz_systems() {
  static const std::set<std::string> settled{"physics",       "sensors",      "imu",
                                             "navsat",        "magnetometer", "contact",
                                             "user-commands", "forcetorque",  "scene-broadcaster"};
  return settled;
}

bool is_settled_gz_system(const PluginDescription& plugin) {
  return settled_gz_systems().count(system_name(plugin.filename)) != 0;
}

void adopt_gz_systems(Model& model, Log& log) {
  std::vector<PluginDescription> plugins;
  for (PluginDescription& plugin : model.plugins) {
    const std::string name = system_name(plugin.filename);
    if (name.empty()) {
      plugins.push_back(std::move(plugin));
    } else if (!is_settled_gz_system(plugin)) {
      adopt_plugin(plugin, name, model, plugins, log);
    }
  }
  model.plugins = std::move(plugins);
  for (Link& link : model.links) adopt_gz_sensors(link, model.plugins, log);
}

}  // namespace ardee
