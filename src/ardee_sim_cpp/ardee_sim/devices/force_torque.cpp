// SPDX-License-Identifier: MIT
#include <string>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {
namespace {

/// libgazebo_ros_ft_sensor.so: the wrench that a joint's child applies to the joint, about the
/// joint's origin, in the axes of the child link, whose name is the frame. A mass hanging on the
/// joint gives m g downwards.
class ForceTorqueSensor : public Sensor {
 public:
  struct Params {
    Mount mount;  // on the child link
    std::size_t joint = 0;
    double gaussian_noise = 0.0;  // N, N m
    std::string topic{};
    std::string frame{};
  };

  ForceTorqueSensor(const std::string& name, const Params& params)
      : Sensor(name, params.mount),
        params_(params),
        output_(add_output(params.topic, reading_kind<WrenchReading>(), params.frame)) {}

  void observe(TimeNs /*now_ns*/) override {
    if (output_.demanded) mount().robot.dynamics().want_joint_wrench(params_.joint);
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& noise, ReadingSink& sink) override {
    const physics::ForceTorque wrench_W = mount().robot.dynamics().joint_wrench(params_.joint);
    const Eigen::Quaterniond q_CW = pose().q.conjugate();
    WrenchReading reading{{now_ns, params_.frame}, {q_CW * wrench_W.force, q_CW * wrench_W.torque}};
    for (int axis = 0; axis < 3; ++axis) {
      const auto counter = static_cast<std::uint64_t>(axis);
      reading.wrench.force[axis] += params_.gaussian_noise * noise.normal(counter);
      reading.wrench.torque[axis] += params_.gaussian_noise * noise.normal(counter + 3);
    }
    sink.on_reading(output_, reading);
  }
  bool wanted() const override { return output_.demanded; }

 private:
  Params params_;
  Output& output_;
};

}  // namespace

std::unique_ptr<Device> make_force_torque(const PluginDescription& plugin, Parameters& parameters,
                                          DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  const std::string joint = parameters.required_text("jointName");
  ForceTorqueSensor::Params params{{context.robot, 0, {}, 0.0, context.seed}};
  params.joint = context.joint_index(joint, parameters.block("jointName")->source);
  const std::string& child = context.robot.model().joints[params.joint].child;
  params.mount.link = context.robot.link_index(child, parameters.source());
  params.mount.rate_hz = read_update_rate_hz(parameters, 0.0);
  params.gaussian_noise = parameters.number("gaussianNoise", 0.0, 0.0);
  params.topic = resolve_topic(parameters.required_text("topicName"), space);
  params.frame = resolve_frame(child, space, context);
  parameters.ignore({"alwaysOn"});
  context.robot.dynamics().want_joint_wrench(params.joint);  // throws for a joint that has none
  return std::make_unique<ForceTorqueSensor>(plugin.name, params);
}

}  // namespace ardee::devices
