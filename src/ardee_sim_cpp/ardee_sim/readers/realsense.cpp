// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/realsense.h"

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/gz_sensors.h"

namespace ardee {
namespace {

constexpr const char* kNearest_m = "0.2";
constexpr const char* kFarthest_m = "10";

/// One of the device's cameras.
struct Eye {
  std::string sensor;  // name after the prefix
  std::string key;     // prefix of its keys: colorTopicName
  std::string rate;    // the key of its rate
  std::string folder;  // default folder of its topics, as in the real device's driver
};

SensorDescription* find_sensor(Model& model, const std::string& name) {
  for (Link& link : model.links) {
    for (SensorDescription& sensor : link.sensors) {
      if (sensor.name == name) return &sensor;
    }
  }
  return nullptr;
}

/// Adds a key of the stock plugin with the value and place of the device plugin's own key.
void copy_key(Parameters& given, const std::string& theirs, const std::string& fallback,
              const std::string& ours, PluginDescription& made) {
  const Element* key = given.block(theirs);
  add_key(made, ours, key && !key->text.empty() ? key->text : fallback);
  if (key) made.element.children.back().source = key->source;
}

void add_depth_keys(Parameters& given, PluginDescription& made) {
  copy_key(given, "depthTopicName", "depth/image_raw", "depthImageTopicName", made);
  copy_key(given, "depthCameraInfoTopicName", "depth/camera_info", "depthImageCameraInfoTopicName",
           made);
  copy_key(given, "pointCloudTopicName", "depth/color/points", "pointCloudTopicName", made);
  copy_key(given, "rangeMinDepth", kNearest_m, "pointCloudCutoff", made);
  copy_key(given, "rangeMaxDepth", kFarthest_m, "pointCloudCutoffMax", made);
  add_key(made, "useDepth16UC1Format", "true");
  // Source of the cloud's colours; the stock plugin's names may be those of an infrared camera.
  add_key(made, "imageTopicName", "depth/color/image_raw");
  add_key(made, "cameraInfoTopicName", "depth/color/camera_info");
}

PluginDescription make_camera(const PluginDescription& device, const Eye& eye,
                              const std::string& sensor, Parameters& given) {
  const bool is_depth = eye.sensor == "depth";
  PluginDescription made;
  made.name = sensor;
  made.filename = is_depth ? "libgazebo_ros_depth_camera.so" : "libgazebo_ros_camera.so";
  made.element.name = "plugin";
  made.element.source = device.element.source;
  copy_key(given, "robotNamespace", "", "robotNamespace", made);
  add_key(made, "cameraName", device.name);
  copy_key(given, eye.rate, "0", "updateRate", made);
  copy_key(given, eye.key + "OpticalframeName", sensor, "frameName", made);
  std::string& frame = made.element.children.back().text;
  frame.insert(0, "/");  // used unchanged in any namespace
  if (is_depth) {
    add_depth_keys(given, made);
  } else {
    copy_key(given, eye.key + "TopicName", eye.folder + "/image_raw", "imageTopicName", made);
    copy_key(given, eye.key + "CameraInfoTopicName", eye.folder + "/camera_info",
             "cameraInfoTopicName", made);
  }
  return made;
}

/// The stock plugin has one nearest depth, for picture and cloud.
void check_cutoff(Parameters& given, Log& log) {
  const Element* cutoff = given.block("pointCloudCutoff");
  const Element* nearest = given.block("rangeMinDepth");
  if (cutoff && to_double(cutoff->text) > to_double(nearest ? nearest->text : kNearest_m)) {
    log.warn(cutoff->source,
             "found more than <rangeMinDepth>, expected at most that: the cloud begins there");
  }
}

void adopt(const PluginDescription& device, Model& model, Log& log) {
  static const Eye eyes[] = {{"color", "color", "colorUpdateRate", "color"},
                             {"ired1", "infrared1", "infraredUpdateRate", "infra1"},
                             {"ired2", "infrared2", "infraredUpdateRate", "infra2"},
                             {"depth", "depth", "depthUpdateRate", "depth"}};
  Parameters given(device.element);
  const std::string prefix = given.text("prefix", "");
  for (const Eye& eye : eyes) {
    const std::string name = prefix + eye.sensor;
    const PluginDescription camera = make_camera(device, eye, name, given);
    if (SensorDescription* sensor = find_sensor(model, name)) {
      sensor->plugins.push_back(camera);
    } else {
      log.warn(device.element.source, "found no <sensor> of its prefix and the camera's name",
               ", expected '" + name + "'; it is left out");
    }
  }
  check_cutoff(given, log);
  given.ignore({"pointCloud"});  // a cloud is made for subscribers only
  given.finish(log);
}

}  // namespace

void adopt_realsense(Model& model, Log& log) {
  std::vector<PluginDescription> others;
  for (PluginDescription& plugin : model.plugins) {
    if (plugin.filename.find("realsense_gazebo_plugin") == std::string::npos) {
      others.push_back(std::move(plugin));
    } else {
      adopt(plugin, model, log);
    }
  }
  model.plugins = std::move(others);
}

}  // namespace ardee
