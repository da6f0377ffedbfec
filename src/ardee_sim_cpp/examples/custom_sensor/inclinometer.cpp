// SPDX-License-Identifier: MIT
#include "inclinometer.h"

#include "ardee_sim/devices/names.h"

using namespace ardee;
using namespace ardee::devices;

std::unique_ptr<Device> Inclinometer::make(const PluginDescription& plugin, Parameters& parameters,
                                           DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  Params params;
  params.topic = resolve_topic(parameters.text("topicName", "inclination"), space);
  params.rate_hz = parameters.number("updateRate", params.rate_hz, 0.0);
  params.noise_std_rad = parameters.number("gaussianNoise", 0.0, 0.0);
  return std::make_unique<Inclinometer>(plugin.name, params, context.seed, context.robot);
}

Inclinometer::Inclinometer(const std::string& name, const Params& params, std::uint64_t seed,
                           const Robot& robot)
    : Device(name),
      params_(params),
      noise_(stream_key(seed, "inclinometer/" + name)),
      robot_(robot),
      timer_(params.rate_hz),
      output_(add_output(params.topic, reading_kind<VectorReading>(), params.rate_hz,
                         robot.model().links.front().name)) {}

void Inclinometer::after_step(TimeNs now_ns, ReadingSink& sink) {
  if (!timer_.due(now_ns) || !output_.demanded) return;
  // The noise of a reading is a function of its index, independent of other readings.
  const CounterRng of_reading = noise_.frame(timer_.count());
  VectorReading reading;
  reading.header = {now_ns, robot_.model().links.front().name};
  reading.vector = rpy_from_quaternion(robot_.pose().q);
  reading.vector.z() = 0.0;
  for (int k = 0; k < 2; ++k) {
    reading.vector[k] += params_.noise_std_rad * of_reading.normal(static_cast<std::uint64_t>(k));
  }
  sink.on_reading(output_, reading);
}

void Inclinometer::reset(TimeNs now_ns) { timer_.start_at(now_ns + 1); }
