// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>

#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/ray_sensor.h"

namespace ardee::devices {
namespace {

/// A lidar over a grid of angles that gives sensor_msgs/PointCloud, row by row, with one unnamed
/// channel of intensities. Each beam has a point; by REP 117 the coordinates of a point without a
/// range are all +inf (nothing within the maximum) or all -inf (nearer than the minimum).
class BlockLidar : public RaySensor {
 public:
  BlockLidar(const std::string& name, const Mount& mount, const Params& params,
             double coordinate_std, RaySceneProvider& scenes)
      : RaySensor(name, mount, params, scenes, reading_kind<LegacyCloudReading>()),
        coordinate_std_(coordinate_std) {}

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  double coordinate_std_;
};

void BlockLidar::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  const std::vector<BeamEcho>& echoes = measure(noise);
  LegacyCloudReading cloud;
  cloud.header = {now_ns, frame()};
  cloud.points.reserve(echoes.size());
  cloud.channel.reserve(echoes.size());
  const std::uint64_t used = echoes.size();  // number of counters that the ranges have used
  for (std::size_t beam = 0; beam < echoes.size(); ++beam) {
    const BeamEcho& echo = echoes[beam];
    const auto error = [&](std::uint64_t k) {
      return coordinate_std_ > 0.0
                 ? static_cast<float>(coordinate_std_ * noise.normal(used + 4 * beam + k))
                 : 0.0f;
    };
    cloud.points.push_back(std::isfinite(echo.range_m)
                               ? Eigen::Vector3f(echo.range_m * beams().axis_S(beam) +
                                                 Eigen::Vector3f(error(0), error(1), error(2)))
                               : Eigen::Vector3f::Constant(echo.range_m));
    cloud.channel.push_back(echo.intensity + error(3));
  }
  sink.on_reading(output(), cloud);
}

}  // namespace

/// libgazebo_ros_block_laser.so; its <gaussianNoise> is added to each coordinate, and to the
/// intensity.
std::unique_ptr<Device> make_block_lidar(const SensorDescription& sensor, Parameters& keys,
                                         std::size_t link, DeviceContext& context) {
  BlockLidar::Params params = read_lidar_params(sensor, keys, scene_of(sensor), "/world", context);
  params.frame = resolve_frame(keys.text("frameName", "/world"), plugin_namespace(keys, context),
                               context);  // the only laser without the namespace there
  const double coordinate_std = read_gaussian_noise(keys);
  const double rate_hz = read_rate_hz(sensor, keys, 0.0);
  keys.ignore({"hokuyoMinIntensity"});  // Gazebo reads and ignores it
  const Sensor::Mount mount{context.robot, link, sensor.X_LS, rate_hz, context.seed};
  return std::make_unique<BlockLidar>(sensor.name, mount, params, coordinate_std, context.scenes);
}

}  // namespace ardee::devices
