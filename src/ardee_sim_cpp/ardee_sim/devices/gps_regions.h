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

/// Effect of a place on the GPS. Factors multiply the open sky's noise.
struct GpsNoise {
  double mean_factor = 1.0;       // on its mean, the offset
  double variance_factor = 1.0;   // on its variance
  double correlated_std_m = 0.0;  // of a slowly varying error, per axis
  double loss_rate_hz = 0.0;      // losses of the fix per second
  double loss_duration_s = 0.0;   // their mean duration
};

/// Combines two effects: factors multiply, errors add as independent ones.
GpsNoise combined(const GpsNoise& one, const GpsNoise& other);

/// Band of Listing A.6: from r1 to below r2 of a quantity (a crop's height in m, its density); r2 =
/// -1: no upper bound.
class NoiseBands {
 public:
  void add(const Element& band, Log& log);
  /// Effect of the first band that contains the value; nullptr if none does.
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

/// Noise drawn anew each period: mean and variance of both factors.
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
  Pose pose;  // of the box's centre
  Eigen::Vector3d size_m{0, 0, 0};
  GpsNoise noise;
  std::optional<PeriodicNoise> periodic;

  bool contains(const Eigen::Vector3d& point_W) const;
};

/// The regions of the variable-accuracy GPS (thesis 4.3.1, Listings A.6 and A.7), from a plugin's
/// keys and the files that it names.
class GpsRegions {
 public:
  GpsRegions() = default;
  /// Inline <field_gps_noise_characteristics>, <plot>, <periodic_noise_box>; <geofenceFile> and
  /// <plotsFile> hold the same elements. A plugin without plots uses those beside `scenery_files`
  /// (plots.xacro); if there are plots but no bands, it uses custom_gps_behavior.geofence of the
  /// resource paths, else default_gps_behavior.geofence. `locator` finds the files. Throws Error
  /// for a missing or malformed file; warns of plots that lie in no band.
  GpsRegions(const Element& plugin, const std::vector<std::string>& scenery_files,
             const ResourceLocator& locator, Log& log);

  /// The first region that contains the point, boxes of periodic noise before plots; nullptr: open
  /// sky.
  const GpsRegion* find(const Eigen::Vector3d& point_W) const;
  const std::vector<GpsRegion>& all() const { return regions_; }

 private:
  struct Parts;

  std::vector<GpsRegion> regions_;
};

}  // namespace ardee::devices
