// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>

#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/ray_sensor.h"
#include "ardee_sim/devices/sensor_model.h"

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

/// Smaller span of the block's angles; a single row has no vertical span.
double smaller_span_rad(const RayBlock& rays) {
  const double across_rad = std::abs(rays.angle_max_rad - rays.angle_min_rad);
  if (rays.rows == 1) return across_rad;
  return std::min(across_rad, rays.elevation_max_rad - rays.elevation_min_rad);
}

/// A sonar or infrared ranger: the nearest range of all rays over its cone. Without a return it
/// reports its maximum; a range below its minimum is reported as the minimum.
class RangeFinder : public RaySensor {
 public:
  struct Params {
    RaySensor::Params ray;
    RangeReading::Radiation radiation = RangeReading::Radiation::kUltrasound;
    double field_of_view_rad = 0.0;  // as reported
    SensorErrors errors;             // of a range below the maximum, m
    bool is_tunable = false;         // the errors can be changed while it runs
  };

  RangeFinder(const std::string& name, const Mount& mount, const Params& params,
              RaySceneProvider& scenes)
      : RaySensor(name, mount, params.ray, scenes, reading_kind<RangeReading>()),
        params_(params),
        model_(params.errors, 1, stream_key(mount.seed, name + " errors")) {
    if (params.is_tunable) add_tuning(model_.tuning(params.ray.topic));
  }

  void reset(TimeNs now_ns) override {
    Sensor::reset(now_ns);
    model_.reset(now_ns, noise_seed());
  }
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(model_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override {
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
  /// Always true: its errors move on without subscribers; rays are cast only for subscribers.
  bool wanted() const override { return true; }

 private:
  /// Range by REP 117: +inf no return, -inf nearer than the minimum.
  double nearest_m(const CounterRng& noise) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const BeamEcho& echo : measure(noise)) nearest = std::min(nearest, echo.range_m);
    return static_cast<double>(nearest);
  }

  Params params_;
  SensorModel model_;
};

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

}  // namespace

/// libgazebo_ros_range.so
std::unique_ptr<Device> make_range_finder(const SensorDescription& sensor, Parameters& keys,
                                          std::size_t link, DeviceContext& context) {
  RangeFinder::Params params = read_params(sensor, keys, "/range", "frameName", "/world", context);
  params.radiation = read_radiation(keys);
  params.field_of_view_rad = keys.number("fov", 0.05, 0.0, 2.0 * M_PI);
  params.errors.gaussian_noise.setConstant(keys.number("gaussianNoise", 0.0, 0.0));
  const double rate_hz = read_rate_hz(sensor, keys, 0.0);
  const Sensor::Mount mount{context.robot, link, sensor.X_LS, rate_hz, context.seed};
  return std::make_unique<RangeFinder>(sensor.name, mount, params, context.scenes);
}

/// libhector_gazebo_ros_sonar.so
std::unique_ptr<Device> make_sonar(const SensorDescription& sensor, Parameters& keys,
                                   std::size_t link, DeviceContext& context) {
  RangeFinder::Params params =
      read_params(sensor, keys, "sonar", "frameId", "/sonar_link", context);
  params.field_of_view_rad = smaller_span_rad(params.ray.rays);
  params.errors = read_sensor_errors(keys, "", read_noise_mode(keys));
  params.is_tunable = true;
  const double rate_hz = read_rate_hz(sensor, keys, kSonarRate_hz);
  const Sensor::Mount mount{context.robot, link, sensor.X_LS, rate_hz, context.seed};
  return std::make_unique<RangeFinder>(sensor.name, mount, params, context.scenes);
}

}  // namespace ardee::devices
