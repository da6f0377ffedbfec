// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/gz_sensors.h"

#include <algorithm>
#include <set>

namespace ardee {
namespace {

/// The text at the end of a path of elements; empty if there is none.
std::string text_at(const Element& element, const std::vector<std::string>& path) {
  const Element* at = &element;
  for (const std::string& name : path) {
    if (at) at = at->child(name);
  }
  return at ? at->text : "";
}

/// Newer Gazebo's name of the frame of a sensor's messages.
std::string frame_of(const SensorDescription& sensor, const Link& link) {
  for (const std::vector<std::string>& path :
       {std::vector<std::string>{"camera", "optical_frame_id"},
        {"gz_frame_id"},
        {"ignition_frame_id"},
        {"frame_id"}}) {
    const std::string frame = text_at(sensor.element, path);
    if (!frame.empty()) return frame;
  }
  return link.name;
}

PluginDescription make_plugin(const SensorDescription& sensor, const char* filename) {
  PluginDescription made;
  made.name = sensor.name;
  made.filename = filename;
  made.element.name = "plugin";
  made.element.source = sensor.element.source;
  return made;
}

/// The block without the elements that the stock plugin gives by its own keys.
void take_out(Element& block, const std::set<std::string>& names) {
  auto& children = block.children;
  children.erase(std::remove_if(children.begin(), children.end(),
                                [&](const Element& child) { return names.count(child.name) != 0; }),
                 children.end());
}

PluginDescription make_lidar(const SensorDescription& sensor, const std::string& topic,
                             const std::string& frame) {
  const bool sees_visuals = sensor.type.rfind("gpu_", 0) == 0;
  std::string rows = text_at(sensor.element, {"lidar", "scan", "vertical", "samples"});
  if (rows.empty()) rows = text_at(sensor.element, {"ray", "scan", "vertical", "samples"});
  const bool is_flat = rows.empty() || rows == "1";
  PluginDescription made = make_plugin(
      sensor, is_flat ? sees_visuals ? "libgazebo_ros_gpu_laser.so" : "libgazebo_ros_laser.so"
              : sees_visuals ? "libgazebo_ros_velodyne_gpu_laser.so"
                             : "libgazebo_ros_velodyne_laser.so");
  add_key(made, "topicName", is_flat ? topic : topic + "/points");
  add_key(made, "frameName", frame);
  if (!is_flat) add_key(made, "organize_cloud", "true");
  return made;
}

/// "camera/image" -> "camera/camera_info", as in newer Gazebo.
std::string info_topic(const SensorDescription& sensor, const std::string& topic) {
  const std::string given = text_at(sensor.element, {"camera", "camera_info_topic"});
  if (!given.empty()) return given;
  const std::size_t slash = topic.rfind('/');
  return slash == std::string::npos ? "camera_info" : topic.substr(0, slash + 1) + "camera_info";
}

PluginDescription make_camera(SensorDescription& sensor, const std::string& topic,
                              const std::string& frame) {
  const bool has_depth = sensor.type != "camera";
  PluginDescription made =
      make_plugin(sensor, has_depth ? "libgazebo_ros_depth_camera.so" : "libgazebo_ros_camera.so");
  add_key(made, "frameName", frame);
  add_key(made, "imageTopicName", has_depth ? topic + "/image" : topic);
  add_key(made, "cameraInfoTopicName",
          has_depth ? topic + "/camera_info" : info_topic(sensor, topic));
  if (has_depth) {
    add_key(made, "depthImageTopicName", topic + "/depth_image");
    add_key(made, "depthImageCameraInfoTopicName", topic + "/depth_camera_info");
    add_key(made, "pointCloudTopicName", topic + "/points");
    add_key(made, "pointCloudCutoff", "0");
  }
  const std::string trigger = text_at(sensor.element, {"camera", "trigger_topic"});
  const std::string triggered = text_at(sensor.element, {"camera", "triggered"});
  if (!triggered.empty()) add_key(made, "triggered", triggered);
  if (!trigger.empty()) add_key(made, "triggerTopicName", trigger);
  for (Element& block : sensor.element.children) {
    if (block.name != "camera") continue;
    take_out(block, {"optical_frame_id", "camera_info_topic", "triggered", "trigger_topic"});
  }
  return made;
}

PluginDescription make_imu(const SensorDescription& sensor, const std::string& topic,
                           const std::string& frame) {
  PluginDescription made = make_plugin(sensor, "libgazebo_ros_imu_sensor.so");
  add_key(made, "topicName", topic);
  add_key(made, "frameName", frame);
  add_key(made, "updateRateHZ", "0");  // the sensor's own <update_rate> counts
  return made;
}

/// Value for one axis of a <noise>; "0" if it is absent.
std::string deviation(const SensorDescription& sensor, const std::vector<std::string>& path) {
  std::vector<std::string> whole = path;
  whole.insert(whole.end(), {"noise", "stddev"});
  const std::string found = text_at(sensor.element, whole);
  return found.empty() ? "0" : found;
}

/// A plugin of the model that measures on a link.
PluginDescription make_on_link(const SensorDescription& sensor, const char* filename,
                               const std::string& topic, const std::string& frame, const Link& link,
                               Log& log) {
  PluginDescription made = make_plugin(sensor, filename);
  add_key(made, "bodyName", link.name);
  add_key(made, "topicName", topic);
  add_key(made, "frameId", frame);
  const std::string rate = text_at(sensor.element, {"update_rate"});
  add_key(made, "updateRate", rate.empty() ? "0" : rate);
  if (!sensor.X_LS.p.isZero() || sensor.X_LS.q.vec().norm() > 1e-9) {
    log.warn(sensor.element.source, "found a <pose>, expected none; it measures at its link's");
  }
  return made;
}

PluginDescription make_navsat(const SensorDescription& sensor, const std::string& topic,
                              const std::string& frame, const Link& link, Log& log) {
  PluginDescription made =
      make_on_link(sensor, "libhector_gazebo_ros_gps.so", topic, frame, link, log);
  add_key(made, "useWorldSphericalCoordinates", "true");
  add_key(made, "velocityTopicName", topic + "/velocity");
  for (const auto& [kind, key] : {std::pair("position_sensing", "gaussianNoise"),
                                  std::pair("velocity_sensing", "velocityGaussianNoise")}) {
    const std::string across = deviation(sensor, {"navsat", kind, "horizontal"});
    add_key(made, key,
            across + " " + across + " " + deviation(sensor, {"navsat", kind, "vertical"}));
  }
  return made;
}

PluginDescription make_magnetometer(const SensorDescription& sensor, const std::string& topic,
                                    const std::string& frame, const Link& link, Log& log) {
  PluginDescription made =
      make_on_link(sensor, "libhector_gazebo_ros_magnetic.so", topic, frame, link, log);
  add_key(made, "useMagneticFieldMsgs", "true");
  // SDF's <magnetic_field> of a world, (5.5645, 22.8758, -42.3884) uT.
  add_key(made, "magnitude", "4.848754830e-5");
  add_key(made, "inclination", "60.95186117");
  add_key(made, "declination", "-76.32841805");
  std::string noise;
  for (const char* axis : {"x", "y", "z"}) noise += deviation(sensor, {"magnetometer", axis}) + " ";
  add_key(made, "gaussianNoise", noise);
  return made;
}

/// Collisions that newer Gazebo's contact system measures.
PluginDescription make_bumper(const SensorDescription& sensor, const std::string& topic,
                              const std::string& frame) {
  PluginDescription made = make_plugin(sensor, "libgazebo_ros_bumper.so");
  add_key(made, "bumperTopicName", topic);
  add_key(made, "frameName", frame);
  return made;
}

/// The topic of a sensor, which a contact sensor has in its <contact> block; empty if there is
/// none.
std::string topic_of(const SensorDescription& sensor) {
  std::string topic = text_at(sensor.element, {"topic"});
  if (topic.empty() && sensor.type == "contact") {
    topic = text_at(sensor.element, {"contact", "topic"});
  }
  return topic == "__default_topic__" || topic == "__default__" ? "" : topic;
}

/// Whether the sensor stays, or a plugin of the model takes its place.
bool adopt_sensor(SensorDescription& sensor, const Link& link,
                  std::vector<PluginDescription>& model_plugins, Log& log) {
  static const std::set<std::string> newer{"gpu_lidar", "lidar", "navsat", "rgbd_camera"};
  const std::string named = topic_of(sensor);
  const bool has_topic = !named.empty();
  if (!sensor.plugins.empty()) return true;
  if (!has_topic && newer.count(sensor.type) == 0) {
    log.warn(sensor.element.source, "found no <plugin> in it, expected one; it publishes nothing");
    return true;
  }
  const std::string topic = has_topic ? named : sensor.name;
  const std::string frame = frame_of(sensor, link);
  const std::string& type = sensor.type;
  if (type == "navsat" || type == "gps") {
    model_plugins.push_back(make_navsat(sensor, topic, frame, link, log));
    return false;
  }
  if (type == "magnetometer") {
    model_plugins.push_back(make_magnetometer(sensor, topic, frame, link, log));
    return false;
  }
  if (type == "gpu_lidar" || type == "lidar" || type == "gpu_ray" || type == "ray") {
    sensor.plugins.push_back(make_lidar(sensor, topic, frame));
  } else if (type == "camera" || type == "rgbd_camera" || type == "depth_camera" ||
             type == "depth") {
    sensor.plugins.push_back(make_camera(sensor, topic, frame));
  } else if (type == "contact") {
    sensor.plugins.push_back(make_bumper(sensor, topic, frame));
  } else if (type == "imu") {
    sensor.plugins.push_back(make_imu(sensor, topic, frame));
  } else {
    log.warn(sensor.element.source,
             "found sensor type '" + type + "', which publishes nothing here; it is left out");
  }
  return true;
}

}  // namespace

void add_key(PluginDescription& plugin, const std::string& name, const std::string& text) {
  Element key;
  key.name = name;
  key.text = text;
  key.source = plugin.element.source;
  plugin.element.children.push_back(std::move(key));
}

void adopt_gz_sensors(Link& link, std::vector<PluginDescription>& model_plugins, Log& log) {
  std::vector<SensorDescription> kept;
  for (SensorDescription& sensor : link.sensors) {
    if (adopt_sensor(sensor, link, model_plugins, log)) kept.push_back(std::move(sensor));
  }
  link.sensors = std::move(kept);
}

}  // namespace ardee
