// SPDX-License-Identifier: MIT
#include <cmath>
#include <optional>
#include <string>

#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/ray_sensor.h"

namespace ardee::devices {
namespace {

constexpr double kMostTimeIncrement_s = 1e3;

/// A planar lidar. Beam i leaves the sensor's origin at angle_min + i * increment about z. All
/// beams are measured at the stamp; the times of a scan are reported as by the drivers of rotating
/// lidars.
class Lidar : public RaySensor {
 public:
  /// `time_increment_s` is the time between beams; none: that of a mirror that turns once per scan.
  Lidar(const std::string& name, const Mount& mount, const Params& params,
        std::optional<double> time_increment_s, RaySceneProvider& scenes)
      : RaySensor(name, mount, params, scenes, reading_kind<LidarReading>()),
        time_increment_s_(time_increment_s) {}

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  std::optional<double> time_increment_s_;
};

void Lidar::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  const std::vector<BeamEcho>& echoes = measure(noise);
  LidarReading reading;
  reading.header = {now_ns, frame()};
  reading.angle_min_rad = rays().angle_min_rad;
  reading.angle_max_rad = rays().angle_max_rad;
  reading.angle_increment_rad = rays().angle_increment_rad();
  reading.scan_time_s = scan_time_s();
  reading.time_increment_s = time_increment_s_.value_or(std::abs(reading.angle_increment_rad) /
                                                        (2.0 * M_PI) * reading.scan_time_s);
  reading.range_min_m = rays().range_min_m;
  reading.range_max_m = rays().range_max_m;
  reading.ranges_m.reserve(echoes.size());
  reading.intensities.reserve(echoes.size());
  for (const BeamEcho& echo : echoes) {
    reading.ranges_m.push_back(echo.range_m);
    reading.intensities.push_back(echo.intensity);
  }
  sink.on_reading(output(), reading);
}

}  // namespace

/// libgazebo_ros_laser.so on collision bodies, libgazebo_ros_gpu_laser.so on visual ones.
std::unique_ptr<Device> make_lidar(const SensorDescription& sensor, Parameters& keys,
                                   std::size_t link, raycast::SceneKind scene,
                                   DeviceContext& context) {
  Lidar::Params params = read_lidar_params(sensor, keys, scene, "/world", context);
  std::optional<double> time_increment_s;
  if (keys.has("timeIncrement")) {
    time_increment_s = keys.number("timeIncrement", 0.0, 0.0, kMostTimeIncrement_s);
  }
  keys.ignore({"updateRate", "gaussianNoise", "hokuyoMinIntensity"});
  if (params.rays.rows > 1) {
    context.log.warn(
        sensor.element.source.to_string() +
        ": found several rows, expected one: a LaserScan holds one, the horizontal one is used");
    params.rays.rows = 1;
  }
  const Sensor::Mount mount{context.robot, link, sensor.X_LS, sensor.update_rate_hz, context.seed};
  return std::make_unique<Lidar>(sensor.name, mount, params, time_increment_s, context.scenes);
}

}  // namespace ardee::devices
