// SPDX-License-Identifier: MIT
#include <algorithm>
#include <sstream>
#include <vector>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {
namespace {

constexpr double kDefaultRateHz = 100.0;  // of the stock plugin

std::vector<std::string> split_at_commas(std::string list) {
  std::replace(list.begin(), list.end(), ',', ' ');
  std::istringstream stream(list);
  std::vector<std::string> names;
  for (std::string name; stream >> name;) names.push_back(name);
  return names;
}

/// libgazebo_ros_joint_state_publisher.so: positions and velocities of the named joints on
/// joint_states; no effort, no frame, as in the stock plugin. Without a namespace of its own or of
/// the spawn it publishes below the model's name.
class JointStatePublisher : public Device {
 public:
  JointStatePublisher(const std::string& name, const std::string& topic,
                      std::vector<std::size_t> joints, double rate_hz, Robot& robot)
      : Device(name),
        joints_(std::move(joints)),
        robot_(robot),
        timer_(rate_hz),
        output_(add_output(topic, reading_kind<JointStateReading>(), rate_hz, "")) {}

  void after_step(TimeNs now_ns, ReadingSink& sink) override {
    if (!timer_.due(now_ns) || !output_.demanded) return;
    JointStateReading reading;
    reading.header.stamp_ns = now_ns;
    for (const std::size_t joint : joints_) {
      reading.names.push_back(robot_.model().joints[joint].name);
      const bool moves =
          robot_.is_dynamic() && robot_.model().joints[joint].type != JointType::kFixed;
      reading.positions.push_back(moves ? robot_.dynamics().joint_position(joint) : 0.0);
      reading.velocities.push_back(moves ? robot_.dynamics().joint_velocity(joint) : 0.0);
    }
    sink.on_reading(output_, reading);
  }
  void reset(TimeNs now_ns) override { timer_.start_at(now_ns + 1); }
  void serialize(StateArchive& state) override { state(timer_); }

 private:
  std::vector<std::size_t> joints_;
  Robot& robot_;
  RateTimer timer_;
  Output& output_;
};

}  // namespace

std::unique_ptr<Device> make_joint_state_publisher(const PluginDescription& plugin,
                                                   Parameters& parameters, DeviceContext& context) {
  std::string space = plugin_namespace(parameters, context);
  if (space.empty() && !parameters.has("robotNamespace")) space = context.robot.name();
  std::vector<std::size_t> joints;
  for (const std::string& name : split_at_commas(parameters.required_text("jointName"))) {
    joints.push_back(context.joint_index(name, plugin.element.source));
  }
  const double rate_hz = read_update_rate_hz(parameters, kDefaultRateHz);
  parameters.ignore({"alwaysOn"});
  return std::make_unique<JointStatePublisher>(plugin.name, resolve_topic("joint_states", space),
                                               std::move(joints), rate_hz, context.robot);
}

}  // namespace ardee::devices
