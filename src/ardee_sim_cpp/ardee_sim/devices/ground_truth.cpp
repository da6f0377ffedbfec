// SPDX-License-Identifier: MIT
#include <optional>
#include <string>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {
namespace {

using Eigen::Vector3d;

/// libgazebo_ros_p3d.so: true pose of a link, in the world or relative to another link of the robot
/// (<frameName>), turned by <rpyOffset> and shifted by <xyzOffset> in that frame. <gaussianNoise>
/// acts on the velocities. These are in the axes of <frameName>, as in the stock plugin;
/// <local_twist> turns them into the link's, as nav_msgs/Odometry says.
class GroundTruth : public Sensor {
 public:
  struct Params {
    Mount mount;
    std::optional<std::size_t> reference_link{};  // none: the world
    Pose offset{};
    double gaussian_noise = 0.0;
    bool local_twist = false;
    std::string topic{};
    std::string frame{};
    std::string child_frame{};
  };

  GroundTruth(const std::string& name, const Params& params)
      : Sensor(name, params.mount),
        params_(params),
        output_(add_output(params.topic, reading_kind<OdometryReading>(), params.frame)) {}

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override;
  bool wanted() const override { return output_.demanded; }

 private:
  /// Pose of the link, and its velocity in the axes of the reference frame.
  void relative_state(Pose& pose, Twist& twist) const {
    pose = this->pose();
    twist = this->twist();
    if (!params_.reference_link) return;
    const Robot& robot = mount().robot;
    const Pose X_WR = robot.link_pose(*params_.reference_link);
    const Twist twist_WR = robot.link_twist(*params_.reference_link);
    const Vector3d arm = pose.p - X_WR.p;
    const Eigen::Quaterniond q_RW = X_WR.q.conjugate();
    twist.linear = q_RW * Vector3d(twist.linear - twist_WR.linear - twist_WR.angular.cross(arm));
    twist.angular = q_RW * Vector3d(twist.angular - twist_WR.angular);
    pose = X_WR.inverse() * pose;
  }

  Params params_;
  Output& output_;
};

void GroundTruth::sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) {
  OdometryReading reading;
  reading.header = {now_ns, params_.frame};
  reading.child_frame_id = params_.child_frame;
  reading.in_odometry_frame = false;
  relative_state(reading.pose, reading.twist);
  if (params_.local_twist) {
    reading.twist.linear = reading.pose.q.conjugate() * reading.twist.linear;
    reading.twist.angular = reading.pose.q.conjugate() * reading.twist.angular;
  }
  reading.pose.p += params_.offset.p;
  reading.pose.q = (params_.offset.q * reading.pose.q).normalized();
  const double std = params_.gaussian_noise;
  for (int axis = 0; axis < 3; ++axis) {
    const auto counter = static_cast<std::uint64_t>(axis);
    reading.twist.linear[axis] += std * noise.normal(counter);
    reading.twist.angular[axis] += std * noise.normal(counter + 3);
  }
  reading.pose_covariance.fill(std * std);
  reading.twist_covariance.fill(std * std);
  sink.on_reading(output_, reading);
}

}  // namespace

std::unique_ptr<Device> make_ground_truth(const PluginDescription& plugin, Parameters& parameters,
                                          DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  const std::string body = parameters.required_text("bodyName");
  GroundTruth::Params params{
      {context.robot, plugin_link(parameters, context), {}, 0.0, context.seed}};
  params.mount.rate_hz = read_update_rate_hz(parameters, 0.0);
  params.topic = resolve_topic(parameters.required_text("topicName"), space);
  const std::string frame = parameters.text("frameName", "world");
  const bool is_world = frame == "world" || frame == "/world" || frame == "map" || frame == "/map";
  if (!is_world) {
    params.reference_link = context.link_index(frame, parameters.block("frameName")->source);
  }
  params.frame = resolve_frame(frame, space, context);
  params.child_frame = resolve_frame(body, space, context);
  params.offset = Pose::from_xyz_rpy(parameters.vector3("xyzOffset", Vector3d::Zero()),
                                     parameters.vector3("rpyOffset", Vector3d::Zero()));
  params.gaussian_noise = parameters.number("gaussianNoise", 0.0, 0.0);
  params.local_twist = parameters.boolean("local_twist", false);
  parameters.ignore({"alwaysOn", "serviceName"});
  return std::make_unique<GroundTruth>(plugin.name, params);
}

}  // namespace ardee::devices
