// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/range_finder.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

constexpr double kSonarRate_hz = 10.0;  // hector_gazebo_ros_sonar's

RangeReading::Radiation read_radiation(Parameters& keys) {
  std::string text = keys.text("radiation", "ultrasound");
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));  // also accepts the message constants' spelling
  });
  if (text == "ultrasound") return RangeReading::Radiation::kUltrasound;
  if (text == "infrared") return RangeReading::Radiation::kInfrared;
  throw keys.error("radiation", "expected ultrasound or infrared");
}

/// Reads the keys that both plugins share; the keys of the frame differ.
RangeFinder::Params read_params(const SensorDescription& sensor, Parameters& keys,
                                const char* topic, const char* frame_key, const char* frame,
                                DeviceContext& context) {
  RangeFinder::Params params;
  params.ray.rays = read_ray_block(sensor, context.log);
  params.ray.scene = scene_of(sensor);
  const std::string space = plugin_namespace(keys, context);
  params.ray.topic = resolve_topic(keys.text("topicName", topic), space);
  params.ray.frame = resolve_frame(keys.text(frame_key, frame), space, context);
  params.ray.look_through_near = keys.boolean("lookThroughNear", false);
  keys.ignore({"alwaysOn"});
  return params;
}

/// Smaller span of the block's angles; a single row has no vertical span.
double smaller_span_rad(const RayBlock& rays) {
  const double across_rad = std::abs(rays.angle_max_rad - rays.angle_min_rad);
  if (rays.rows == 1) return across_rad;
  return std::min(across_rad, rays.elevation_max_rad - rays.elevation_min_rad);
}

}  // namespace

std::unique_ptr<Device> RangeFinder::make_range(const SensorDescription& sensor, Parameters& keys,
                                                std::size_t link, DeviceContext& context) {
  Params params = read_params(sensor, keys, "/range", "frameName", "/world", context);
  params.radiation = read_radiation(keys);
  params.field_of_view_rad = keys.number("fov", 0.05, 0.0, 2.0 * M_PI);
  params.errors.gaussian_noise.setConstant(keys.number("gaussianNoise", 0.0, 0.0));
  const double rate_hz = read_rate_hz(sensor, keys, 0.0);
  const Mount mount{context.robot, link, sensor.X_LS, rate_hz, context.seed};
  return std::make_unique<RangeFinder>(sensor.name, mount, params, context.scenes);
}

std::unique_ptr<Device> RangeFinder::make_sonar(const SensorDescription& sensor, Parameters& keys,
                                                std::size_t link, DeviceContext& context) {
  Params params = read_params(sensor, keys, "sonar", "frameId", "/sonar_link", context);
  params.field_of_view_rad = smaller_span_rad(params.ray.rays);
  params.errors = read_sensor_errors(keys, "", read_noise_mode(keys));
  params.is_tunable = true;
  const double rate_hz = read_rate_hz(sensor, keys, kSonarRate_hz);
  const Mount mount{context.robot, link, sensor.X_LS, rate_hz, context.seed};
  return std::make_unique<RangeFinder>(sensor.name, mount, params, context.scenes);
}

RangeFinder::RangeFinder(const std::string& name, const Mount& mount, const Params& params,
                         RaySceneProvider& scenes)
    : RaySensor(name, mount, params.ray, scenes, reading_kind<RangeReading>()),
      params_(params),
      model_(params.errors, 1, stream_key(mount.seed, name + " errors")) {
  if (params.is_tunable) add_tuning(model_.tuning(params.ray.topic));
}

void RangeFinder::reset(TimeNs now_ns) {
  Sensor::reset(now_ns);
  model_.reset(now_ns, noise_seed());
}

double RangeFinder::nearest_m(const CounterRng& noise) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const BeamEcho& echo : measure(noise)) nearest = std::min(nearest, echo.range_m);
  return static_cast<double>(nearest);
}

void RangeFinder::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  const double error_m = model_.next_error(elapsed_s()).x();
  if (!output().demanded) return;
  double range_m = nearest_m(noise);
  if (std::isfinite(range_m)) range_m = range_m * model_.errors().scale_error.x() + error_m;
  RangeReading reading;
  reading.header = {now_ns, frame()};
  reading.radiation = params_.radiation;
  reading.field_of_view_rad = params_.field_of_view_rad;
  reading.range_min_m = rays().range_min_m;
  reading.range_max_m = rays().range_max_m;
  reading.range_m = std::clamp(range_m, rays().range_min_m, rays().range_max_m);
  sink.on_reading(output(), reading);
}

}  // namespace ardee::devices
