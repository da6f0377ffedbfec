// SPDX-License-Identifier: MIT
#include <string>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/inertial_sensor.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sdf_imu_noise.h"

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

Pose read_mounting(Parameters& parameters) {
  return Pose::from_xyz_rpy(parameters.vector3("xyzOffset", Vector3d::Zero()),
                            parameters.vector3("rpyOffset", Vector3d::Zero()));
}

/// libgazebo_ros_imu.so, a model plugin, and libgazebo_ros_imu_sensor.so, in a <sensor type="imu">.
/// The acceleration of the first excludes gravity (0 at rest) unless <gravity> is true; that of the
/// second includes gravity and the errors of its <imu> block. Both add white noise of
/// <gaussianNoise>. <xyzOffset> and <rpyOffset> are the mounting in the body. Unlike the stock ones
/// they rotate the right way, find bodies in their own robot only, and keep orientations of unit
/// length.
class GazeboImu : public InertialSensor {
 public:
  struct Params {
    Mount mount;
    SdfImuNoise noise{};
    double gaussian_noise = 0.0;     // rad/s and m/s^2, as in the stock plugins
    bool noisy_orientation = false;  // gaussian_noise on the quaternion's components too
    bool feels_gravity = true;
    bool initial_orientation_is_reference = false;
    std::string topic{};
    std::string frame{};
    std::string service{};  // it answers and does nothing: white noise has no bias; empty: none
  };

  GazeboImu(const std::string& name, const Params& params,
            std::function<Vector3d()> gravity_m_per_s2)
      : InertialSensor(name, params.mount, std::move(gravity_m_per_s2)),
        params_(params),
        accel_(params.noise.accel.errors, 3, stream_key(params.mount.seed, name + "/accel")),
        rate_(params.noise.rate.errors, 3, stream_key(params.mount.seed, name + "/rate")),
        output_(add_output(params.topic, reading_kind<ImuReading>(), params.frame)) {
    if (!params.service.empty()) add_service(params.service, std::function<void()>([] {}));
  }

  void reset(TimeNs now_ns) override {
    InertialSensor::reset(now_ns);
    accel_.reset(now_ns, noise_seed());
    rate_.reset(now_ns, noise_seed());
    if (params_.initial_orientation_is_reference) q_RW_ = pose().q.conjugate();
  }
  void serialize(StateArchive& state) override {
    InertialSensor::serialize(state);
    state(accel_, rate_, q_RW_);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  Params params_;
  SensorModel accel_;
  SensorModel rate_;
  Eigen::Quaterniond q_RW_ = Eigen::Quaterniond::Identity();  // world in the reference
  Output& output_;
};

void GazeboImu::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  const InertialMotion::Mean motion = take_motion();
  const double std = params_.gaussian_noise;
  const auto white = [&noise, std](std::uint64_t first) {
    return Vector3d(std * noise.normal(first), std * noise.normal(first + 1),
                    std * noise.normal(first + 2));
  };
  ImuReading reading;
  reading.header = {now_ns, params_.frame};
  const Vector3d force = params_.feels_gravity ? motion.specific_force() : motion.acceleration;
  const Vector3d rate = rate_.corrupt(motion.angular_velocity, elapsed_s());
  const Vector3d accel = accel_.corrupt(force, elapsed_s());
  reading.angular_velocity = params_.noise.rate.quantised(rate) + white(0);
  reading.linear_acceleration = params_.noise.accel.quantised(accel) + white(3);
  reading.orientation = q_RW_ * pose().q;
  if (params_.noisy_orientation) {
    // A component of a small rotation's quaternion is half its angle.
    const Vector3d half = white(6);
    reading.orientation =
        reading.orientation * Eigen::Quaterniond(1.0, half.x(), half.y(), half.z());
  }
  reading.orientation.normalize();
  const double variance = std * std;
  reading.orientation_covariance.fill(variance);
  reading.angular_velocity_covariance.fill(variance);
  reading.linear_acceleration_covariance.fill(variance);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    reading.angular_velocity_covariance[axis] += rate_.noise_variance()[i];
    reading.linear_acceleration_covariance[axis] += accel_.noise_variance()[i];
  }
  if (output_.demanded) sink.on_reading(output_, reading);
}

}  // namespace

std::unique_ptr<Device> make_imu_on_model(const PluginDescription& plugin, Parameters& parameters,
                                          DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  const std::string body = parameters.required_text("bodyName");
  GazeboImu::Params params{{context.robot, plugin_link(parameters, context),
                            read_mounting(parameters), 0.0, context.seed}};
  params.mount.rate_hz = read_update_rate_hz(parameters, 0.0);
  params.gaussian_noise = parameters.number("gaussianNoise", 0.0, 0.0);
  params.feels_gravity = parameters.boolean("gravity", false);
  params.topic = resolve_topic(parameters.text("topicName", "/default_imu"), space);
  const std::string service = parameters.text("serviceName", "/default_imu");
  if (!service.empty()) params.service = resolve_topic(service, space);
  params.frame = resolve_frame(parameters.text("frameName", body), space, context);
  parameters.ignore({"alwaysOn", "updateRateHZ"});
  return std::make_unique<GazeboImu>(plugin.name, params, context.world_info.gravity_m_per_s2);
}

std::unique_ptr<Device> make_imu_on_sensor(const SensorDescription& sensor, Parameters& parameters,
                                           std::size_t link, DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  GazeboImu::Params params{
      {context.robot, link, sensor.X_LS * read_mounting(parameters), 0.0, context.seed}};
  if (!parameters.has("updateRateHZ")) {
    context.log.warn(parameters.source().to_string() +
                     ": found no <updateRateHZ>, expected one: it defaults to 1, whatever the "
                     "sensor's <update_rate>, as in Gazebo");
  }
  const double rate_hz = parameters.number("updateRateHZ", 1.0, 0.0, limits::kMostRate_hz);
  params.mount.rate_hz = slower_rate_hz(sensor.update_rate_hz, rate_hz);
  params.gaussian_noise = parameters.number("gaussianNoise", 0.0, 0.0);
  params.noisy_orientation = true;
  params.initial_orientation_is_reference =
      parameters.boolean("initialOrientationAsReference", false);
  params.topic = resolve_topic(parameters.text("topicName", "imu_data"), space);
  params.frame = resolve_frame(parameters.required_text("frameName"), space, context);
  if (const Element* imu = sensor.element.child("imu")) {
    const std::uint64_t key = stream_key(context.seed, sensor.name + "/bias");
    params.noise = read_sdf_imu_noise(*imu, key);
  }
  parameters.ignore({"alwaysOn", "bodyName", "serviceName"});
  return std::make_unique<GazeboImu>(sensor.name, params, context.world_info.gravity_m_per_s2);
}

}  // namespace ardee::devices
