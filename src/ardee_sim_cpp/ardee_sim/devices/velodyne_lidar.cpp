// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/pose_track.h"
#include "ardee_sim/devices/ray_sensor.h"

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

/// A rotating lidar of several rings that gives point clouds in the layout of Velodyne's driver,
/// with each point's label and instance in bytes that are free there, and its time counted from the
/// stamp.
///
/// Points come column by column and in a column from the lowest ring up. By default a scan is taken
/// at one time; a scan with motion distortion ends at its stamp, its columns are spread evenly over
/// the preceding turn, and each point is given, as by the real device, in the sensor's frame at the
/// point's own time. Other models keep their poses of the stamp.
class VelodyneLidar : public RaySensor {
 public:
  struct Params {
    RaySensor::Params lidar;
    // Points out of (min_range_m, max_range_m), or below the minimum intensity, are left out.
    double min_range_m = 0.0;
    double max_range_m = std::numeric_limits<double>::max();
    double min_intensity = std::numeric_limits<double>::lowest();
    bool organised = false;  // NaN for points that are left out; a row of the cloud is a column
    bool motion_distortion = false;
  };

  VelodyneLidar(const std::string& name, const Mount& mount, const Params& params,
                RaySceneProvider& scenes)
      : RaySensor(name, mount, params.lidar, scenes, reading_kind<PointCloudReading>()),
        params_(params),
        track_(mount.rate_hz > 0.0 ? nanoseconds(1.0 / mount.rate_hz) : 0) {}

  void observe(TimeNs now_ns) override {
    if (is_distorted()) track_.add(now_ns, pose());
  }
  void reset(TimeNs now_ns) override {
    Sensor::reset(now_ns);
    track_.clear();
  }
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(track_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override {
    PointCloudReading cloud =
        to_cloud(is_distorted() ? measure_distorted(now_ns, noise) : measure(noise));
    cloud.header = {now_ns, frame()};
    sink.on_reading(output(), cloud);
  }

 private:
  bool is_distorted() const { return params_.motion_distortion && mount().robot.is_dynamic(); }
  /// Poses at the columns' own times.
  const std::vector<BeamEcho>& measure_distorted(TimeNs now_ns, const CounterRng& noise) {
    track_.add(now_ns, pose());
    std::vector<Pose> X_WS;
    X_WS.reserve(static_cast<std::size_t>(rays().columns));
    for (int column = 0; column < rays().columns; ++column) {
      X_WS.push_back(track_.at(static_cast<double>(now_ns) + column_time_ns(column)));
    }
    return measure_moving(X_WS, noise);
  }
  /// Time of a column's beams from the stamp: 0 or less.
  double column_time_ns(int column) const {
    if (!params_.motion_distortion) return 0.0;
    const double turn = std::abs(rays().angle_max_rad - rays().angle_min_rad) / (2.0 * M_PI);
    const double sweep_ns = std::min(turn, 1.0) * scan_time_s() * kNsPerSecond;
    const int last = rays().columns - 1;
    return last > 0 ? double(column - last) / last * sweep_ns : 0.0;
  }
  bool keeps(const BeamEcho& echo) const {
    const auto range_m = static_cast<double>(echo.range_m);
    return std::isfinite(range_m) && range_m > params_.min_range_m &&
           range_m < params_.max_range_m &&
           static_cast<double>(echo.intensity) >= params_.min_intensity;
  }
  PointCloudReading to_cloud(const std::vector<BeamEcho>& echoes) const;

  Params params_;
  PoseTrack track_;
};

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

}  // namespace

/// libgazebo_ros_velodyne_laser.so on collision bodies, libgazebo_ros_velodyne_gpu_laser.so on
/// visual ones.
std::unique_ptr<Device> make_velodyne_lidar(const SensorDescription& sensor, Parameters& keys,
                                            std::size_t link, raycast::SceneKind scene,
                                            DeviceContext& context) {
  VelodyneLidar::Params params;
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
  const Sensor::Mount mount{context.robot, link, sensor.X_LS, sensor.update_rate_hz, context.seed};
  return std::make_unique<VelodyneLidar>(sensor.name, mount, params, context.scenes);
}

}  // namespace ardee::devices
