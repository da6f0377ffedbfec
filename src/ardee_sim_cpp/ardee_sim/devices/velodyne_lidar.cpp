// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/velodyne_lidar.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ardee::devices {
namespace {

using Type = PointCloudReading::Type;

/// The fields of velodyne_pointcloud, at velodyne_simulator's places; label and instance are ours.
const std::vector<PointCloudReading::Field> kFields{
    {"x", 0, Type::kFloat32},          {"y", 4, Type::kFloat32},       {"z", 8, Type::kFloat32},
    {"intensity", 16, Type::kFloat32}, {"ring", 20, Type::kUint16},    {"label", 24, Type::kUint32},
    {"time", 28, Type::kFloat32},      {"instance", 12, Type::kUint32}};
constexpr std::uint32_t kPointStep = 32;

template <typename T>
void write(std::uint8_t* point, std::size_t offset, T value) {
  std::memcpy(point + offset, &value, sizeof value);
}

}  // namespace

std::unique_ptr<Device> VelodyneLidar::make(const SensorDescription& sensor, Parameters& keys,
                                            std::size_t link, raycast::SceneKind scene,
                                            DeviceContext& context) {
  Params params;
  params.lidar = read_lidar_params(sensor, keys, scene, "/points", context);
  params.min_range_m = keys.number("min_range", params.min_range_m, 0.0);
  params.max_range_m = keys.number("max_range", params.max_range_m, 0.0);
  if (params.max_range_m <= params.min_range_m) {
    throw keys.error("max_range", "expected more than <min_range>");
  }
  params.min_intensity = keys.number("min_intensity", params.min_intensity);
  params.organised = keys.boolean("organised", keys.boolean("organize_cloud", false));
  params.motion_distortion = keys.boolean("motionDistortion", false);
  // Combines two independent errors.
  RangeNoise& noise = params.lidar.rays.noise;
  noise.std_m = std::hypot(noise.std_m, read_gaussian_noise(keys));
  const Mount mount{context.robot, link, sensor.X_LS, sensor.update_rate_hz, context.seed};
  return std::make_unique<VelodyneLidar>(sensor.name, mount, params, context.scenes);
}

VelodyneLidar::VelodyneLidar(const std::string& name, const Mount& mount, const Params& params,
                             RaySceneProvider& scenes)
    : RaySensor(name, mount, params.lidar, scenes, reading_kind<PointCloudReading>()),
      params_(params),
      track_(mount.rate_hz > 0.0 ? nanoseconds(1.0 / mount.rate_hz) : 0) {}

void VelodyneLidar::observe(TimeNs now_ns) {
  if (is_distorted()) track_.add(now_ns, pose());
}

void VelodyneLidar::reset(TimeNs now_ns) {
  Sensor::reset(now_ns);
  track_.clear();
}

const std::vector<BeamEcho>& VelodyneLidar::measure_distorted(TimeNs now_ns,
                                                              const CounterRng& noise) {
  track_.add(now_ns, pose());
  std::vector<Pose> X_WS;
  X_WS.reserve(static_cast<std::size_t>(rays().columns));
  for (int column = 0; column < rays().columns; ++column) {
    X_WS.push_back(track_.at(static_cast<double>(now_ns) + column_time_ns(column)));
  }
  return measure_moving(X_WS, noise);
}

double VelodyneLidar::column_time_ns(int column) const {
  if (!params_.motion_distortion) return 0.0;
  const double turn = std::abs(rays().angle_max_rad - rays().angle_min_rad) / (2.0 * M_PI);
  const double sweep_ns = std::min(turn, 1.0) * scan_time_s() * kNsPerSecond;
  const int last = rays().columns - 1;
  return last > 0 ? double(column - last) / last * sweep_ns : 0.0;
}

bool VelodyneLidar::keeps(const BeamEcho& echo) const {
  const auto range_m = static_cast<double>(echo.range_m);
  return std::isfinite(range_m) && range_m > params_.min_range_m && range_m < params_.max_range_m &&
         static_cast<double>(echo.intensity) >= params_.min_intensity;
}

PointCloudReading VelodyneLidar::to_cloud(const std::vector<BeamEcho>& echoes) const {
  const auto columns = static_cast<std::size_t>(rays().columns);
  const auto rings = static_cast<std::size_t>(rays().rows);
  PointCloudReading cloud;
  cloud.fields = kFields;
  cloud.point_step = kPointStep;
  cloud.data.resize(beams().count() * kPointStep);
  std::uint8_t* point = cloud.data.data();
  for (std::size_t column = 0; column < columns; ++column) {
    const double time_s = column_time_ns(static_cast<int>(column)) / kNsPerSecond;
    for (std::size_t ring = 0; ring < rings; ++ring) {
      const std::size_t beam = ring * columns + column;
      const BeamEcho& echo = echoes[beam];
      const bool kept = keeps(echo);
      if (!kept && !params_.organised) continue;
      const float range_m = kept ? echo.range_m : std::numeric_limits<float>::quiet_NaN();
      const Eigen::Vector3f place_S = range_m * beams().axis_S(beam);
      std::memcpy(point, place_S.data(), 3 * sizeof(float));
      write(point, 12, kept ? echo.entity + 1 : 0u);
      write(point, 16, kept ? echo.intensity : 0.0f);
      write(point, 20, static_cast<std::uint16_t>(ring));
      write(point, 24, kept ? echo.label : 0u);
      write(point, 28, static_cast<float>(time_s));
      point += kPointStep;
    }
  }
  cloud.data.resize(static_cast<std::size_t>(point - cloud.data.data()));
  cloud.width =
      static_cast<std::uint32_t>(params_.organised ? rings : cloud.data.size() / kPointStep);
  cloud.height = static_cast<std::uint32_t>(params_.organised ? columns : 1);
  cloud.is_dense = !params_.organised;
  return cloud;
}

void VelodyneLidar::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  PointCloudReading cloud =
      to_cloud(is_distorted() ? measure_distorted(now_ns, noise) : measure(noise));
  cloud.header = {now_ns, frame()};
  sink.on_reading(output(), cloud);
}

}  // namespace ardee::devices
