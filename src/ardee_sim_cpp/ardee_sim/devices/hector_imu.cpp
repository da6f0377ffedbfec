// SPDX-License-Identifier: MIT
#include <optional>
#include <string>
#include <utility>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/inertial_sensor.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor_model.h"
#include "ardee_sim/devices/vibration.h"

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

std::array<double, 3> diagonal(const Vector3d& variances) {
  return {variances.x(), variances.y(), variances.z()};
}

/// libhector_gazebo_ros_imu.so: specific force, angular velocity and the orientation of an attitude
/// filter that trusts its biased sensors, each with hector's errors (<accel...>, <rate...>,
/// <yaw...>). <xyzOffset> and <rpyOffset> are the mounting in the body (hector reads the first but
/// does not apply it, and applies the second in the world). <vibrationStdAccel> adds vibration in
/// proportion to the robot's speed over ground.
class HectorImu : public InertialSensor {
 public:
  struct Params {
    Mount mount;
    SensorErrors accel{};
    SensorErrors rate{};
    SensorErrors yaw{};
    std::optional<VibrationParams> vibration{};
    std::string topic{};
    std::string bias_topic{};
    std::string calibrate_service{};
    std::string frame{};
  };

  HectorImu(const std::string& name, const Params& params,
            std::function<Eigen::Vector3d()> gravity_m_per_s2);

  void reset(TimeNs now_ns) override {
    InertialSensor::reset(now_ns);
    for (SensorModel* model : {&accel_, &rate_, &yaw_}) model->reset(now_ns, noise_seed());
    if (vibration_) vibration_->reset(now_ns, noise_seed());
    take_vibration();
    followed_ns_ = now_ns;
  }
  void serialize(StateArchive& state) override {
    InertialSensor::serialize(state);
    state(accel_, rate_, yaw_, vibration_, mean_vibration_, shaken_s_, followed_ns_);
  }

 protected:
  void follow(TimeNs now_ns) override {
    InertialSensor::follow(now_ns);
    if (vibration_) shake(seconds(now_ns - followed_ns_));
    followed_ns_ = now_ns;
  }
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;

 private:
  Eigen::Quaterniond orientation_error(const Eigen::Quaterniond& q_WS) const {
    const Eigen::AngleAxisd turn(yaw_.bias().x(), Vector3d::UnitZ());
    const double g = gravity().norm();
    if (g <= 0.0) return Eigen::Quaterniond(turn);
    // A filter that levels itself by a biased accelerometer is tilted by bias / g.
    const Vector3d bias_W = q_WS * accel_.bias();
    const Eigen::Quaterniond tilt(1.0, 0.5 * bias_W.y() / g, -0.5 * bias_W.x() / g, 0.0);
    return turn * tilt.normalized();
  }
  void shake(double dt_s) {
    vibration_->step(dt_s);
    const double speed_m_per_s = mount().robot.twist().linear.head<2>().norm();
    shaken_s_ += dt_s;
    mean_vibration_ += dt_s / shaken_s_ * (vibration_->at_speed(speed_m_per_s) - mean_vibration_);
  }
  /// Mean vibration since the last call.
  Eigen::Vector3d take_vibration() {
    shaken_s_ = 0.0;
    return std::exchange(mean_vibration_, Vector3d::Zero());
  }
  void set_covariances(ImuReading& reading) const {
    const Vector3d accel = accel_.noise_variance();
    reading.linear_acceleration_covariance = diagonal(accel);
    reading.angular_velocity_covariance = diagonal(rate_.noise_variance());
    const double g2 = gravity().squaredNorm();
    if (g2 > 0.0) {
      reading.orientation_covariance = {accel.x() / g2, accel.y() / g2, yaw_.noise_variance().x()};
    }
  }

  SensorModel accel_;
  SensorModel rate_;
  SensorModel yaw_;
  std::optional<Vibration> vibration_;
  Eigen::Vector3d mean_vibration_{0, 0, 0};  // over the last shaken_s_
  double shaken_s_ = 0.0;
  TimeNs followed_ns_ = 0;
  std::string frame_;
  Output& output_;
  Output& bias_output_;
};

std::uint64_t key_of(const HectorImu::Params& params, const std::string& name, const char* part) {
  return stream_key(params.mount.seed, name + "/" + part);
}

HectorImu::HectorImu(const std::string& name, const Params& params,
                     std::function<Vector3d()> gravity_m_per_s2)
    : InertialSensor(name, params.mount, std::move(gravity_m_per_s2)),
      accel_(params.accel, 3, key_of(params, name, "accel")),
      rate_(params.rate, 3, key_of(params, name, "rate")),
      yaw_(params.yaw, 1, key_of(params, name, "yaw")),
      frame_(params.frame),
      output_(add_output(params.topic, reading_kind<ImuReading>(), params.frame)),
      bias_output_(add_output(params.bias_topic, reading_kind<ImuReading>(), params.frame)) {
  if (params.vibration) vibration_.emplace(*params.vibration, key_of(params, name, "vibration"));
  add_service(params.calibrate_service, [this] { rate_.set_drift(Vector3d::Zero()); });
  add_service(params.topic + "/set_accel_bias",
              [this](const Vector3d& bias) { accel_.set_drift(checked_bias(bias)); });
  add_service(params.topic + "/set_rate_bias",
              [this](const Vector3d& bias) { rate_.set_drift(checked_bias(bias)); });
  add_tuning(accel_.tuning(params.topic + "/accel"));
  add_tuning(rate_.tuning(params.topic + "/rate"));
  add_tuning(yaw_.tuning(params.topic + "/yaw"));
}

void HectorImu::sample(TimeNs now_ns, const CounterRng& /*noise*/, ReadingSink& sink) {
  const InertialMotion::Mean motion = take_motion();
  const Eigen::Quaterniond q_WS = pose().q;
  ImuReading reading;
  reading.header = {now_ns, frame_};
  reading.linear_acceleration =
      accel_.corrupt(motion.specific_force() + take_vibration(), elapsed_s());
  reading.angular_velocity = rate_.corrupt(motion.angular_velocity, elapsed_s());
  yaw_.next_error(elapsed_s());
  const Eigen::Quaterniond error = orientation_error(q_WS);
  reading.orientation = (error * q_WS).normalized();
  set_covariances(reading);
  if (output_.demanded) sink.on_reading(output_, reading);
  if (!bias_output_.demanded) return;
  ImuReading bias;
  bias.header = reading.header;
  bias.orientation = error;
  bias.angular_velocity = rate_.bias();
  bias.linear_acceleration = accel_.bias();
  sink.on_reading(bias_output_, bias);
}

}  // namespace

std::unique_ptr<Device> make_hector_imu(const PluginDescription& plugin, Parameters& parameters,
                                        DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  HectorImu::Params params{
      {context.robot, plugin_link(parameters, context), {}, 0.0, context.seed}};
  params.mount.X_LS = Pose::from_xyz_rpy(parameters.vector3("xyzOffset", Vector3d::Zero()),
                                         parameters.vector3("rpyOffset", Vector3d::Zero()));
  read_update_times(parameters, 0.0, params.mount);
  const NoiseMode mode = read_noise_mode(parameters);
  params.accel = read_sensor_errors(parameters, "accel", mode);
  params.rate = read_sensor_errors(parameters, "rate", mode);
  params.yaw = read_sensor_errors(parameters, "yaw", mode);
  const double of_both = parameters.number("gaussianNoise", 0.0, 0.0);
  if (of_both > 0.0) {
    params.accel.gaussian_noise.setConstant(of_both);
    params.rate.gaussian_noise.setConstant(of_both);
  }
  params.vibration = read_vibration(parameters);
  const std::string topic = parameters.text("topicName", "imu");
  params.topic = resolve_topic(topic, space);
  params.bias_topic = resolve_topic(parameters.text("biasTopicName", topic + "/bias"), space);
  params.calibrate_service =
      resolve_topic(parameters.text("serviceName", topic + "/calibrate"), space);
  const std::string link = context.robot.model().links[params.mount.link].name;
  params.frame = resolve_frame(parameters.text("frameId", link), space, context);
  parameters.ignore({"alwaysOn"});
  return std::make_unique<HectorImu>(plugin.name, params, context.world_info.gravity_m_per_s2);
}

}  // namespace ardee::devices
