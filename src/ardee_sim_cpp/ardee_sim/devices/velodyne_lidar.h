// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/pose_track.h"
#include "ardee_sim/devices/ray_sensor.h"

namespace ardee::devices {

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

  /// libgazebo_ros_velodyne_laser.so on collision bodies, libgazebo_ros_velodyne_gpu_laser.so on
  /// visual ones.
  static std::unique_ptr<Device> make(const SensorDescription& sensor, Parameters& keys,
                                      std::size_t link, raycast::SceneKind scene,
                                      DeviceContext& context);
  VelodyneLidar(const std::string& name, const Mount& mount, const Params& params,
                RaySceneProvider& scenes);

  void observe(TimeNs now_ns) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(track_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  bool is_distorted() const { return params_.motion_distortion && mount().robot.is_dynamic(); }
  /// Poses at the columns' own times.
  const std::vector<BeamEcho>& measure_distorted(TimeNs now_ns, const CounterRng& noise);
  /// Time of a column's beams from the stamp: 0 or less.
  double column_time_ns(int column) const;
  bool keeps(const BeamEcho& echo) const;
  PointCloudReading to_cloud(const std::vector<BeamEcho>& echoes) const;

  Params params_;
  PoseTrack track_;
};

}  // namespace ardee::devices
