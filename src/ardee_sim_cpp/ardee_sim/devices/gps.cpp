// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/gps.h"

#include <cmath>
#include <limits>

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

constexpr int kStatusNoFix = -1;  // sensor_msgs/NavSatStatus

}  // namespace

std::unique_ptr<Device> Gps::make(const PluginDescription& plugin, Parameters& parameters,
                                  DeviceContext& context) {
  const GpsParams params = read_gps_params(parameters, context);
  return std::make_unique<Gps>(plugin.name, params);
}

Gps::Gps(const std::string& name, const GpsParams& params)
    : Sensor(name, params.mount),
      initial_frame_on_earth_(params.frame_on_earth),
      frame_on_earth_(params.frame_on_earth),
      position_(params.position, 3, stream_key(params.mount.seed, name + "/position")),
      velocity_(params.velocity, 3, stream_key(params.mount.seed, name + "/velocity")),
      initial_status_(params.status),
      initial_service_(params.service),
      status_(params.status),
      service_(params.service),
      frame_(params.frame),
      fix_output_(add_output(params.fix_topic, reading_kind<FixReading>(), params.frame)),
      velocity_output_(
          add_output(params.velocity_topic, reading_kind<VectorReading>(), params.frame)) {
  add_service(params.fix_topic + "/set_reference_geopose",
              [this](const GeoPose& pose) { set_reference(pose); });
  add_tuning(position_.tuning(params.fix_topic + "/position"));
  add_tuning(velocity_.tuning(params.fix_topic + "/velocity"));
  add_tuning(gnss_tuning(params.fix_topic + "/status", status_, service_));
}

void Gps::set_reference(const GeoPose& pose) {
  const GeoPoint origin{pose.latitude_deg, pose.longitude_deg, pose.altitude_m};
  const bool valid = std::abs(origin.latitude_deg) <= 89.9 &&
                     std::abs(origin.longitude_deg) <= 360.0 && std::isfinite(origin.altitude_m);
  if (!valid) {
    throw Error("found latitude " + std::to_string(origin.latitude_deg) + ", longitude " +
                std::to_string(origin.longitude_deg) + ", altitude " +
                std::to_string(origin.altitude_m) +
                ", expected at most 89.9 and 360 degrees and a finite altitude");
  }
  // In east-north-up a yaw counts counterclockwise from east; a heading clockwise from north.
  const double heading_rad = M_PI / 2.0 - rpy_from_quaternion(pose.orientation).z();
  frame_on_earth_ = LocalFrame(origin, heading_rad, frame_on_earth_.projection());
}

void Gps::reset(TimeNs now_ns) {
  Sensor::reset(now_ns);
  position_.reset(now_ns, noise_seed());
  velocity_.reset(now_ns, noise_seed());
  frame_on_earth_ = initial_frame_on_earth_;
  status_ = initial_status_;
  service_ = initial_service_;
}

Gps::Sky Gps::sky(const Vector3d& /*position_W*/, TimeNs /*now_ns*/) { return {}; }

Vector3d Gps::position_error(const Vector3d& position_W, const Sky& sky) {
  const SensorErrors& errors = position_.errors();
  const Vector3d random = position_.next_error(elapsed_s()) - errors.offset;
  const Vector3d scaled = position_W.cwiseProduct(errors.scale_error) - position_W;
  return scaled + sky.offset_factor * errors.offset + std::sqrt(sky.variance_factor) * random +
         sky.extra_error_m;
}

FixReading Gps::fix(TimeNs now_ns, const Vector3d& measured_W, const Sky& sky,
                    const Vector3d& variance_m2) const {
  FixReading reading;
  reading.header = {now_ns, frame_};
  reading.status = sky.has_fix ? status_ : kStatusNoFix;
  reading.service = static_cast<std::uint16_t>(service_);
  // East and north are a mixture of x and y.
  const double sine = std::sin(frame_on_earth_.heading_rad());
  const double share = sine * sine;
  reading.covariance = {share * variance_m2.x() + (1.0 - share) * variance_m2.y(),
                        (1.0 - share) * variance_m2.x() + share * variance_m2.y(), variance_m2.z()};
  if (sky.has_fix) {
    const GeoPoint point = frame_on_earth_.to_geodetic(measured_W);
    reading.latitude_deg = point.latitude_deg;
    reading.longitude_deg = point.longitude_deg;
    reading.altitude_m = point.altitude_m;
  } else {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    reading.latitude_deg = reading.longitude_deg = reading.altitude_m = kUnknown;
  }
  return reading;
}

void Gps::sample(TimeNs now_ns, const CounterRng& /*noise*/, ReadingSink& sink) {
  const Vector3d position_W = pose().p;
  const Sky sky = this->sky(position_W, now_ns);
  const Vector3d error_W = position_error(position_W, sky);
  const Vector3d velocity_W = velocity_.corrupt(twist().linear, elapsed_s());
  // As in hector: the drift of the velocity drifts in the position as its integral.
  position_.set_drift(position_.drift() + elapsed_s() * velocity_.drift());
  const Vector3d variance_m2 = sky.variance_factor * position_.variance() +
                               Vector3d::Constant(sky.extra_std_m * sky.extra_std_m);
  if (fix_output_.demanded) {
    sink.on_reading(fix_output_, fix(now_ns, position_W + error_W, sky, variance_m2));
  }
  // A receiver without a fix knows no velocity.
  if (velocity_output_.demanded && sky.has_fix) {
    sink.on_reading(velocity_output_,
                    VectorReading{{now_ns, frame_}, frame_on_earth_.to_nwu(velocity_W)});
  }
  report(now_ns, sky, error_W, variance_m2.cwiseSqrt(), sink);
}

}  // namespace ardee::devices
