// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/lidar_params.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/names.h"

namespace ardee {
namespace {

constexpr int kMostBeams = 1 << 20;
constexpr double kTwoTurns = 4.0 * M_PI;

const Element& required_block(const Element& parent, const char* name) {
  const Element* block = parent.child(name);
  if (!block) throw Error(parent.source, "found no <" + std::string(name) + ">, expected one");
  return *block;
}

void read_scan(const Element& scan, LidarParams& params, Log& log) {
  Parameters horizontal(required_block(scan, "horizontal"));
  const int samples = horizontal.integer("samples", 640, 1, kMostBeams);
  const double resolution = horizontal.number("resolution", 1.0, 1e-6, 1e6);
  params.samples =
      static_cast<int>(std::clamp(std::round(samples * resolution), 1.0, double(kMostBeams)));
  params.angle_min_rad = horizontal.number("min_angle", 0.0, -kTwoTurns, kTwoTurns);
  params.angle_max_rad = horizontal.number("max_angle", 0.0, -kTwoTurns, kTwoTurns);
  horizontal.finish(log);
  if (const Element* vertical = scan.child("vertical")) {
    Parameters parameters(*vertical);
    if (parameters.integer("samples", 1, 1, kMostBeams) > 1) {
      log.warn(
          vertical->source.to_string() +
          ": found several rows, expected one: a LaserScan holds one, the horizontal one is used");
    }
  }
}

void read_range(const Element& range, LidarParams& params, Log& log) {
  Parameters parameters(range);
  params.range_min_m = parameters.number("min", 0.0, 0.0, 1e6);
  params.range_max_m = parameters.number("max", 0.0, 0.0, 1e6);
  if (params.range_max_m <= params.range_min_m) {
    throw parameters.error("max", "expected more than <min>");
  }
  parameters.ignore({"resolution"});  // Gazebo does not quantise ranges either
  parameters.finish(log);
}

void read_noise(const Element& noise, LidarParams& params, Log& log) {
  Parameters parameters(noise);
  const std::string type = noise.attributes.count("type") ? noise.attributes.at("type")
                                                          : parameters.text("type", "none");
  const double mean = parameters.number("mean", 0.0);
  const double std = parameters.number("stddev", 0.0, 0.0);
  const double precision = parameters.number("precision", 0.0, 0.0);
  parameters.ignore({"type", "bias_mean", "bias_stddev"});
  parameters.finish(log);
  if (type == "none") return;
  if (type != "gaussian" && type != "gaussian_quantized") {
    throw Error(noise.source,
                "found noise type '" + type + "', expected gaussian, gaussian_quantized or none");
  }
  if (type == "gaussian_quantized") params.precision_m = precision;
  params.noise_mean_m = mean;
  params.noise_std_m = std;
}

}  // namespace

LidarParams read_lidar_params(const SensorDescription& sensor, const PluginDescription& plugin,
                              SceneKind scene, DeviceContext& context) {
  LidarParams params;
  params.scene = scene;
  const Element* ray = sensor.element.child("ray");
  if (!ray) ray = sensor.element.child("lidar");
  if (!ray) {
    throw Error(sensor.element.source, "sensor '" + sensor.name + "' of type '" + sensor.type +
                                           "': found no <ray>, expected one");
  }
  read_scan(required_block(*ray, "scan"), params, context.log);
  read_range(required_block(*ray, "range"), params, context.log);
  if (const Element* noise = ray->child("noise")) read_noise(*noise, params, context.log);

  Parameters parameters(plugin.element);
  const std::string space = plugin_namespace(parameters, context);
  params.topic = resolve_topic(parameters.text("topicName", "/world"), space);
  params.frame = resolve_frame(parameters.text("frameName", "/world"), space, context);
  params.look_through_near = parameters.boolean("lookThroughNear", false);
  parameters.ignore({"alwaysOn", "updateRate", "gaussianNoise", "hokuyoMinIntensity"});
  parameters.finish(context.log);
  return params;
}

}  // namespace ardee
