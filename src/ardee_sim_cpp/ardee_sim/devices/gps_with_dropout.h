// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/gps.h"
#include "ardee_sim/devices/gps_regions.h"

namespace ardee::devices {

/// libgazebo_ros_gps_with_dropout.so (thesis 4.3.1): hector's GPS, degraded within regions and
/// unchanged outside of them. In a region its noise is multiplied; an error that is correlated in
/// time is added (first-order Gauss-Markov, <correlationTime> s); and the fix is lost and regained
/// at random (a two-state Markov process). Beside the fix it publishes the present degradation, and
/// once the regions for rviz.
class GpsWithDropout : public Gps {
 public:
  struct Params {
    GpsParams gps;
    Element plugin{};  // its keys of regions
    // Measured with a receiver without RTK under 2 m of corn at 1 Hz.
    double correlation_time_s = 12.0;
    std::string quality_topic{};
    std::string regions_topic{};
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  GpsWithDropout(const std::string& name, const Params& params, const DeviceContext& context);

  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override {
    Gps::serialize(state);
    state(random_, unit_error_, has_fix_, loss_duration_s_, region_, regions_shown_);
  }

 protected:
  Sky sky(const Eigen::Vector3d& position_W, TimeNs now_ns) override;
  void report(TimeNs now_ns, const Sky& sky, const Eigen::Vector3d& error_W,
              const Eigen::Vector3d& std_m, ReadingSink& sink) override;

 private:
  /// Updates the regions when fields are added or removed.
  void follow_scenery();
  GpsNoise noise_in(const GpsRegion& region, TimeNs now_ns) const;
  void move_error();
  void move_fix(const GpsNoise& noise);
  RegionsReading regions_reading(TimeNs now_ns) const;

  Element plugin_;
  WorldInfo world_info_;
  const ResourceLocator& locator_;
  Log& log_;
  std::vector<std::string> scenery_files_;  // from which the regions were read
  std::uint64_t scenery_changes_;
  GpsRegions regions_;
  double correlation_time_s_;
  std::uint64_t key_;
  Rng random_;
  CounterRng periods_;
  Eigen::Vector3d unit_error_{0, 0, 0};  // of unit variance
  bool has_fix_ = true;
  double loss_duration_s_ = 0.0;  // of the region where the fix was lost
  std::string region_;            // where the last sample was taken
  bool regions_shown_ = false;
  Output& quality_output_;
  Output& regions_output_;
};

}  // namespace ardee::devices
