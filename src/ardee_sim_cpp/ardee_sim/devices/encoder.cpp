// SPDX-License-Identifier: MIT
#include <string>

#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/wheel_encoder.h"

namespace ardee::devices {
namespace {

/// libardee_ros_encoder.so (thesis 4.3.1, Listing A.5): one encoder on a joint, with its own topic.
class Encoder : public Device {
 public:
  Encoder(const std::string& name, const std::string& topic, const WheelEncoder::Params& params,
          double rate_hz, Robot& robot)
      : Device(name),
        encoder_(params, robot),
        timer_(rate_hz),
        output_(add_output(topic, reading_kind<EncoderReading>(), rate_hz, params.frame)) {}

  void after_step(TimeNs now_ns, ReadingSink& sink) override {
    if (timer_.due(now_ns)) sink.on_reading(output_, encoder_.read(now_ns));
  }
  void reset(TimeNs now_ns) override {
    timer_.start_at(now_ns + 1);
    encoder_.reset(now_ns);
  }
  void serialize(StateArchive& state) override { state(encoder_, timer_); }

 private:
  WheelEncoder encoder_;
  RateTimer timer_;
  Output& output_;
};

}  // namespace

std::unique_ptr<Device> make_encoder(const PluginDescription& plugin, Parameters& parameters,
                                     DeviceContext& context) {
  constexpr double kDefaultRate_hz = 100.0;
  constexpr double kLowestRate_hz = 1e-3;
  const std::string space = plugin_namespace(parameters, context);
  WheelEncoder::Params params = read_encoder_params(parameters);
  const std::string joint = parameters.required_text("joint");
  params.joint = turning_joint(context, joint, parameters.block("joint")->source);
  params.id = parameters.integer("id", 0, 0, 1 << 30);
  const Joint& description = context.robot.model().joints[params.joint];
  params.frame = resolve_frame(parameters.text("frameName", description.child), space, context);
  const std::string topic = resolve_topic(parameters.text("encoderTopic", "encoder"), space);
  const double rate_hz = parameters.number("updateRate", kDefaultRate_hz, kLowestRate_hz);
  parameters.ignore({"robotBaseFrame", "alwaysOn"});
  return std::make_unique<Encoder>(plugin.name, topic, params, rate_hz, context.robot);
}

}  // namespace ardee::devices
