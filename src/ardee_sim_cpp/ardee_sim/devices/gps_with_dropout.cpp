// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/devices/gps.h"
#include "ardee_sim/devices/gps_regions.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

/// "gps/fix" and "gps" mean the topics below "gps"; "fix" means those of the namespace.
std::string topic_beside(const std::string& fix_topic, const char* name) {
  const std::string ending = "/fix";
  std::string base = fix_topic;
  if (base.size() >= ending.size() &&
      base.compare(base.size() - ending.size(), ending.size(), ending) == 0) {
    base.resize(base.size() - ending.size());
  }
  return base + "/" + name;
}

/// Colour of a region: green if it has no effect, over yellow to red at an error of 1.5 m or a
/// variance multiplied by 5 (the worst band of Listing A.6).
std::array<float, 4> colour_of(const GpsRegion& region) {
  constexpr double kWorst_m = 1.5, kWorstFactor = 5.0, kOpacity = 0.25;
  const double variance =
      region.periodic ? region.periodic->variance_mean : region.noise.variance_factor;
  const double badness = std::clamp(
      std::max(region.noise.correlated_std_m / kWorst_m, (variance - 1.0) / (kWorstFactor - 1.0)),
      0.0, 1.0);
  return {static_cast<float>(std::min(1.0, 2.0 * badness)),
          static_cast<float>(std::min(1.0, 2.0 - 2.0 * badness)), 0.0f,
          static_cast<float>(kOpacity)};
}

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

  GpsWithDropout(const std::string& name, const Params& params, const DeviceContext& context);

  void reset(TimeNs now_ns) override {
    Gps::reset(now_ns);
    const std::uint64_t key = reseeded(key_, noise_seed());
    random_ = Rng(key, now_ns);
    periods_ = CounterRng(mix_bits(key));
    for (int axis = 0; axis < 3; ++axis) unit_error_[axis] = random_.normal();
    has_fix_ = true;
    loss_duration_s_ = 0.0;
    regions_shown_ = false;
  }
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
  void follow_scenery() {
    if (world_info_.scenery_changes() == scenery_changes_) return;
    scenery_changes_ = world_info_.scenery_changes();
    std::vector<std::string> files = world_info_.scenery_files();
    if (files == scenery_files_) return;
    scenery_files_ = std::move(files);
    try {
      regions_ = GpsRegions(plugin_, scenery_files_, locator_, log_);
    } catch (const Error& error) {
      log_.error("GPS '" + name() + "' keeps its regions: " + error.what());
      return;
    }
    regions_shown_ = false;
  }
  GpsNoise noise_in(const GpsRegion& region, TimeNs now_ns) const {
    if (!region.periodic) return region.noise;
    const auto number = static_cast<std::uint64_t>(&region - regions_.all().data());
    return region.periodic->at(now_ns, periods_.frame(number));  // each box has its own draws
  }
  void move_error() {
    // Exact at any rate: x(t + dt) = phi x(t) + sqrt(1 - phi^2) N(0, 1), phi = exp(-dt / tau).
    const double phi = std::exp(-elapsed_s() / correlation_time_s_);
    const double fresh = std::sqrt(-std::expm1(-2.0 * elapsed_s() / correlation_time_s_));
    for (int axis = 0; axis < 3; ++axis) {
      unit_error_[axis] = phi * unit_error_[axis] + fresh * random_.normal();
    }
  }
  void move_fix(const GpsNoise& noise) {
    if (noise.loss_duration_s > 0.0) loss_duration_s_ = noise.loss_duration_s;
    const double losses_hz = noise.loss_rate_hz;
    const double recoveries_hz = loss_duration_s_ > 0.0 ? 1.0 / loss_duration_s_ : 0.0;
    const double draw = random_.uniform();
    if (losses_hz + recoveries_hz <= 0.0) return;
    // Two states in continuous time, seen dt apart: the probability of loss is the stationary one
    // plus the decaying influence of the present state.
    const double both_hz = losses_hz + recoveries_hz;
    const double stationary = losses_hz / both_hz;
    const double kept = std::exp(-both_hz * elapsed_s());
    const double lost = stationary + ((has_fix_ ? 0.0 : 1.0) - stationary) * kept;
    has_fix_ = draw >= lost;
  }
  RegionsReading regions_reading(TimeNs now_ns) const {
    RegionsReading reading;
    reading.header = {now_ns, "world"};
    for (const GpsRegion& region : regions_.all()) {
      reading.regions.push_back({region.name, region.pose, region.size_m, colour_of(region)});
    }
    return reading;
  }

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

GpsWithDropout::GpsWithDropout(const std::string& name, const Params& params,
                               const DeviceContext& context)
    : Gps(name, params.gps),
      plugin_(params.plugin),
      world_info_(context.world_info),
      locator_(context.locator),
      log_(context.log),
      scenery_files_(world_info_.scenery_files()),
      scenery_changes_(world_info_.scenery_changes()),
      regions_(plugin_, scenery_files_, locator_, log_),
      correlation_time_s_(params.correlation_time_s),
      key_(stream_key(params.gps.mount.seed, name + "/dropout")),
      random_(key_),
      periods_(mix_bits(key_)),
      quality_output_(add_output(params.quality_topic, reading_kind<GpsQualityReading>(), "world")),
      regions_output_(add_output(params.regions_topic, reading_kind<RegionsReading>(), "world")) {
  regions_output_.latched = true;
  regions_output_.rate_hz.reset();
}

Gps::Sky GpsWithDropout::sky(const Vector3d& position_W, TimeNs now_ns) {
  follow_scenery();
  const GpsRegion* region = regions_.find(position_W);
  GpsNoise noise;
  if (region) noise = noise_in(*region, now_ns);
  region_ = region ? region->name : "";
  move_error();
  move_fix(noise);
  Sky sky;
  sky.offset_factor = noise.mean_factor;
  sky.variance_factor = noise.variance_factor;
  sky.extra_std_m = noise.correlated_std_m;
  sky.extra_error_m = noise.correlated_std_m * unit_error_;
  sky.has_fix = has_fix_;
  return sky;
}

void GpsWithDropout::report(TimeNs now_ns, const Sky& sky, const Vector3d& error_W,
                            const Vector3d& std_m, ReadingSink& sink) {
  if (!regions_shown_) {
    sink.on_reading(regions_output_, regions_reading(now_ns));
    regions_shown_ = true;
  }
  if (!quality_output_.demanded) return;
  GpsQualityReading reading;
  reading.header = {now_ns, "world"};
  reading.region = region_;
  reading.position_std_m = std::sqrt(0.5 * (std_m.x() * std_m.x() + std_m.y() * std_m.y()));
  reading.has_fix = sky.has_fix;
  reading.error_m = sky.has_fix ? frame_on_earth().to_enu(error_W)
                                : Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  sink.on_reading(quality_output_, reading);
}

}  // namespace

std::unique_ptr<Device> make_gps_with_dropout(const PluginDescription& plugin,
                                              Parameters& parameters, DeviceContext& context) {
  constexpr double kShortest_s = 1e-3;
  GpsWithDropout::Params params{read_gps_params(parameters, context), plugin.element};
  params.correlation_time_s = parameters.number("correlationTime", params.correlation_time_s,
                                                kShortest_s, limits::kLongestTime_s);
  const std::string space = plugin_namespace(parameters, context);
  const auto topic = [&](const char* key, const char* name) {
    return parameters.has(key) ? resolve_topic(parameters.text(key, ""), space)
                               : topic_beside(params.gps.fix_topic, name);
  };
  params.quality_topic = topic("dataTopicName", "data");
  params.regions_topic = topic("regionsTopicName", "regions");
  for (const char* key : {"field_gps_noise_characteristics", "plot", "periodic_noise_box",
                          "geofenceFile", "plotsFile"}) {
    parameters.block(key);  // read by GpsRegions
  }
  return std::make_unique<GpsWithDropout>(plugin.name, params, context);
}

}  // namespace ardee::devices
