// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/block_lidar.h"

#include <cmath>

#include "ardee_sim/devices/lidar.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {

std::unique_ptr<Device> BlockLidar::make(const SensorDescription& sensor,
                                         const PluginDescription& plugin, std::size_t link,
                                         DeviceContext& context) {
  Parameters keys(plugin.element);
  LidarParams params = read_lidar_params(sensor, keys, scene_of(sensor), "/world", context);
  params.frame = resolve_frame(keys.text("frameName", "/world"), plugin_namespace(keys, context),
                               context);  // of the lasers this one alone has no namespace there
  const double coordinate_std = read_gaussian_noise(keys);
  const double rate_hz = read_rate_hz(sensor, keys, 0.0);
  keys.ignore({"hokuyoMinIntensity"});  // Gazebo reads it and does nothing with it
  keys.finish(context.log);
  const Mount mount{context.robot, link, sensor.X_LS, rate_hz, context.seed};
  return std::make_unique<BlockLidar>(sensor.name, mount, params, coordinate_std, context.scenes);
}

BlockLidar::BlockLidar(const std::string& name, const Mount& mount, const LidarParams& params,
                       double coordinate_std, RaySceneProvider& scenes)
    : Sensor(name, mount),
      params_(params),
      coordinate_std_(coordinate_std),
      scenes_(scenes),
      beams_(params.rays, params.optics, params.look_through_near,
             {mount.robot.entity(), static_cast<std::uint32_t>(mount.link)}),
      eye_(scenes.register_eye(params.scene, [this] { return pose().p; })),
      output_(add_output(params.topic, reading_kind<LegacyCloudReading>())) {}

void BlockLidar::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  beams_.measure(pose(), scenes_.now(params_.scene), echoes_);
  corrupt_echoes(params_.rays, noise, echoes_);
  LegacyCloudReading cloud;
  cloud.header = {now_ns, params_.frame};
  cloud.points.reserve(echoes_.size());
  cloud.channel.reserve(echoes_.size());
  const std::uint64_t beams = echoes_.size();  // corrupt_echoes has used as many counters
  for (std::size_t beam = 0; beam < echoes_.size(); ++beam) {
    const BeamEcho& echo = echoes_[beam];
    const auto error = [&](std::uint64_t k) {
      return coordinate_std_ > 0.0
                 ? static_cast<float>(coordinate_std_ * noise.normal(beams + 4 * beam + k))
                 : 0.0f;
    };
    cloud.points.push_back(std::isfinite(echo.range_m)
                               ? Eigen::Vector3f(echo.range_m * beams_.axis_S(beam) +
                                                 Eigen::Vector3f(error(0), error(1), error(2)))
                               : Eigen::Vector3f::Constant(echo.range_m));
    cloud.channel.push_back(echo.intensity + error(3));
  }
  sink.on_reading(output_, cloud);
}

}  // namespace ardee::devices
