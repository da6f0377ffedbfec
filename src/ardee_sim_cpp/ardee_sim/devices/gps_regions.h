// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/core/rng.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/readers/resource_locator.h"

namespace ardee::devices {

/// What a place does to the GPS. Factors are those of the open sky's noise.
struct GpsNoise {
  double mean_factor = 1.0;       // of its mean, the offset
  double variance_factor = 1.0;   // of its variance
  double correlated_std_m = 0.0;  // of an error that comes and goes slowly, each axis
  double loss_rate_hz = 0.0;      // losses of the fix a second
  double loss_duration_s = 0.0;   // their mean duration
};

/// Both together: factors multiply, errors add as independent ones do.
GpsNoise combined(const GpsNoise& one, const GpsNoise& other);

/// Listing A.6: from r1 to below r2 of something (a crop's height in m, its density), r2 = -1: on.
class NoiseBands {
 public:
  void add(const Element& band, Log& log);
  /// Of the first band that holds the value; nullptr: none does.
  const GpsNoise* find(double value) const;
  bool empty() const { return bands_.empty(); }

 private:
  struct Band {
    double low = 0.0;
    double high = 0.0;
    GpsNoise noise;
  };
  std::vector<Band> bands_;
};

/// Noise that is drawn anew each period: mean and variance of both its factors.
struct PeriodicNoise {
  double period_s = 1.0;
  double mean_mean = 1.0;
  double mean_variance = 0.0;
  double variance_mean = 1.0;
  double variance_variance = 0.0;

  GpsNoise at(TimeNs now_ns, const CounterRng& stream) const;
};

/// A box in the world within which the GPS is degraded.
struct GpsRegion {
  std::string name;
  Pose pose;  // of the box's middle
  Eigen::Vector3d size_m{0, 0, 0};
  GpsNoise noise;
  std::optional<PeriodicNoise> periodic;

  bool contains(const Eigen::Vector3d& point_W) const;
};

/// The regions of the variable-accuracy GPS (thesis 4.3.1, Listings A.6 and A.7), from what a
/// plugin says and from the files that it names.
class GpsRegions {
 public:
  GpsRegions() = default;
  /// Inline <field_gps_noise_characteristics>, <plot>, <periodic_noise_box>; <geofenceFile> and
  /// <plotsFile> with the same. Without plots of its own, those beside `scenery_files`
  /// (plots.xacro); if there are plots but no bands, the resource paths'
  /// custom_gps_behavior.geofence, else default_gps_behavior.geofence. `locator` finds the files.
  /// Throws Error for what is missing or malformed; warns of plots that lie in no band.
  GpsRegions(const Element& plugin, const std::vector<std::string>& scenery_files,
             const ResourceLocator& locator, Log& log);

  /// The first that contains the point, boxes of periodic noise before plots; nullptr: open sky.
  const GpsRegion* find(const Eigen::Vector3d& point_W) const;
  const std::vector<GpsRegion>& all() const { return regions_; }

 private:
  struct Parts;

  std::vector<GpsRegion> regions_;
};

}  // namespace ardee::devices
