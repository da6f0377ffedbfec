// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/gps_params.h"

#include <cmath>

#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

constexpr double kMostLatitude_deg = 89.9;  // at a pole there is no east

// sensor_msgs/NavSatStatus
enum Status { kNoFix = -1, kFix = 0, kSbas = 1, kGbas = 2 };
enum Service { kGps = 1, kGlonass = 2, kCompass = 4, kGalileo = 8 };

LocalFrame::Projection read_projection(Parameters& parameters) {
  const std::string projection = parameters.text("projection", "flat");
  if (projection == "flat") return LocalFrame::Projection::kFlat;
  if (projection == "tangent") return LocalFrame::Projection::kTangent;
  throw parameters.error("projection", "expected flat or tangent");
}

LocalFrame read_frame_on_earth(Parameters& parameters, DeviceContext& context) {
  const LocalFrame::Projection projection = read_projection(parameters);
  // Defaults: hector's, a place in Darmstadt.
  GeoPoint origin{49.9, 8.9, 0.0};
  origin.latitude_deg = parameters.number("referenceLatitude", origin.latitude_deg,
                                          -kMostLatitude_deg, kMostLatitude_deg);
  origin.longitude_deg =
      parameters.number("referenceLongitude", origin.longitude_deg, -360.0, 360.0);
  origin.altitude_m = parameters.number("referenceAltitude", 0.0, -1e5, 1e7);
  double heading_deg = parameters.number("referenceHeading", 0.0, -360.0, 360.0);
  const bool uses_world = parameters.boolean("useWorldSphericalCoordinates", false);
  const bool prefers_world = parameters.boolean("preferWorldSphericalCoordinates", false);
  const auto& world = context.world_info.spherical_coordinates;
  if (world && (uses_world || prefers_world)) {
    if (std::abs(world->latitude_deg) > kMostLatitude_deg) {
      throw parameters.error(
          uses_world ? "useWorldSphericalCoordinates" : "preferWorldSphericalCoordinates",
          "expected a world less than 89.9 degrees from the equator");
    }
    origin = {world->latitude_deg, world->longitude_deg, world->elevation_m};
    heading_deg = 90.0 - world->heading_deg;
  } else if (uses_world) {
    context.log.warn(parameters.source().to_string() +
                     ": found no <spherical_coordinates> in the world, expected them for "
                     "useWorldSphericalCoordinates; the plugin's own reference is used");
  }
  return {origin, heading_deg * kDegree, projection};
}

}  // namespace

GpsParams read_gps_params(Parameters& parameters, DeviceContext& context) {
  constexpr double kDefaultRateHz = 4.0;  // hector's
  const std::string space = plugin_namespace(parameters, context);
  GpsParams params{{context.robot, plugin_link(parameters, context), {}, 0.0, context.seed},
                   read_frame_on_earth(parameters, context)};
  read_update_times(parameters, kDefaultRateHz, params.mount);
  const NoiseMode mode = read_noise_mode(parameters);
  params.position = read_sensor_errors(parameters, "", mode);
  params.velocity = read_sensor_errors(parameters, "velocity", mode);
  params.status = parameters.integer("status", kFix, kNoFix, kGbas);
  params.service = parameters.integer("service", 0, 0, kGps | kGlonass | kCompass | kGalileo);
  params.fix_topic = resolve_topic(parameters.text("topicName", "fix"), space);
  params.velocity_topic =
      resolve_topic(parameters.text("velocityTopicName", "fix_velocity"), space);
  params.frame = resolve_frame(parameters.text("frameId", "/world"), space, context);
  parameters.ignore({"alwaysOn"});
  return params;
}

ParameterGroup gnss_tuning(const std::string& name, int& status, int& service) {
  const auto tunable = [](const char* key, const char* about, std::function<bool()> get,
                          std::function<void(bool)> set) {
    TunableParameter made{key, about, TunableParameter::Type::kBool, 0.0, 1.0, get() ? 1.0 : 0.0,
                          {},  {}};
    made.get = [get = std::move(get)] { return get() ? 1.0 : 0.0; };
    made.set = [set = std::move(set)](double value) { set(value != 0.0); };
    return made;
  };
  const auto augmented = [&](const char* key, const char* about, int kind) {
    return tunable(
        key, about, [&status, kind] { return status == kind; },
        [&status, kind](bool on) {
          if (on && status != kNoFix) status = kind;
          if (!on && status == kind) status = kFix;
        });
  };
  const auto system = [&](const char* key, const char* about, int bit) {
    return tunable(
        key, about, [&service, bit] { return (service & bit) != 0; },
        [&service, bit](bool on) { service = on ? service | bit : service & ~bit; });
  };
  const auto fix = tunable(
      "STATUS_FIX", "Unaugmented fix", [&status] { return status != kNoFix; },
      [&status](bool on) {
        if (!on) status = kNoFix;
        if (on && status == kNoFix) status = kFix;
      });
  return {name,
          {fix, augmented("STATUS_SBAS_FIX", "Fix with satellite-based augmentation", kSbas),
           augmented("STATUS_GBAS_FIX", "Fix with ground-based augmentation", kGbas),
           system("SERVICE_GPS", "GPS service", kGps),
           system("SERVICE_GLONASS", "GLONASS service", kGlonass),
           system("SERVICE_COMPASS", "COMPASS service", kCompass),
           system("SERVICE_GALILEO", "GALILEO service", kGalileo)}};
}

}  // namespace ardee::devices
