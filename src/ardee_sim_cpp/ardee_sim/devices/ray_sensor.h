// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/lidar_beams.h"
#include "ardee_sim/devices/lidar_optics.h"
#include "ardee_sim/devices/ray_block.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {

/// A sensor with SDF's <ray> block: the base of lidars, sonars and range finders, which make their
/// readings of the echoes.
class RaySensor : public Sensor {
 public:
  struct Params {
    RayBlock rays;
    LidarOptics optics;
    raycast::SceneKind scene = raycast::SceneKind::kCollision;
    bool look_through_near =
        false;  // as in Gazebo, rays pass through surfaces nearer than the minimum
    std::string topic;
    std::string frame;
  };

 protected:
  /// `kind` is that of its reading.
  RaySensor(const std::string& name, const Mount& mount, const Params& params,
            RaySceneProvider& scenes, std::size_t kind);

  bool wanted() const override { return output_.demanded; }
  /// The echoes of all beams now, with the noise of their ranges; beam i uses counter i. Valid
  /// until it is called again.
  const std::vector<BeamEcho>& measure(const CounterRng& noise);
  /// Returns of all beams if those of column k leave from X_WS[k].
  const std::vector<BeamEcho>& measure_moving(const std::vector<Pose>& X_WS,
                                              const CounterRng& noise);
  /// Time since the previous scan; for use in sample().
  double scan_time_s() const;

  const RayBlock& rays() const { return params_.rays; }
  const std::string& frame() const { return params_.frame; }
  const LidarBeams& beams() const { return beams_; }
  const Output& output() const { return output_; }

 private:
  const std::vector<BeamEcho>& corrupted(const CounterRng& noise);

  Params params_;
  RaySceneProvider& scenes_;
  LidarBeams beams_;
  std::shared_ptr<void> eye_;
  std::vector<BeamEcho> echoes_;
  Output& output_;
};

/// Reads and checks SDF's <ray> block and the keys that all lidars share; the caller reads the
/// other keys.
RaySensor::Params read_lidar_params(const SensorDescription& sensor, Parameters& plugin,
                                    raycast::SceneKind scene, const char* default_topic,
                                    DeviceContext& context);

/// Scene of a sensor's rays if the plugin's name does not define it: rays of type gpu_ray hit
/// visual bodies, those of type ray collision bodies (thesis 4.3.3).
raycast::SceneKind scene_of(const SensorDescription& sensor);

/// The rate of a plugin with its own <updateRate>: the slower of that and the sensor's. A rate of 0
/// is no limit.
double read_rate_hz(const SensorDescription& sensor, Parameters& plugin, double fallback_hz);

/// The plugin's <gaussianNoise>: a standard deviation.
double read_gaussian_noise(Parameters& plugin);

}  // namespace ardee::devices
