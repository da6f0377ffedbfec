// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/link_force.h"

#include "ardee_sim/devices/names.h"

namespace ardee::devices {

std::unique_ptr<Device> LinkForce::make(const PluginDescription& plugin, Parameters& parameters,
                                        DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  const std::string body = parameters.required_text("bodyName");
  const std::size_t link = context.link_index(body, parameters.block("bodyName")->source);
  Params params{{context.robot, link, {}, 0.0, context.seed}};
  params.topic = resolve_topic(parameters.required_text("topicName"), space);
  params.frame = resolve_frame(parameters.text("frameName", "world"), space, context);
  params.world_info = context.world_info;
  parameters.ignore({"alwaysOn", "updateRate"});
  return std::make_unique<LinkForce>(plugin.name, params);
}

LinkForce::LinkForce(const std::string& name, const Params& params)
    : Sensor(name, params.mount),
      params_(params),
      scope_(params.mount.robot.name() +
             "::" + params.mount.robot.model().links[params.mount.link].name + "::"),
      output_(add_output(params.topic, reading_kind<WrenchReading>(), params.frame)) {}

void LinkForce::observe(TimeNs /*now_ns*/) {
  if (output_.demanded) params_.world_info.want_contacts();
}

void LinkForce::sample(TimeNs now_ns, const CounterRng& /*noise*/, ReadingSink& sink) {
  WrenchReading reading{{now_ns, params_.frame}, {}};
  const auto add = [&](const std::string& collision, const physics::ForceTorque& wrench) {
    if (collision.compare(0, scope_.size(), scope_) != 0) return;
    reading.wrench.force += wrench.force;
    reading.wrench.torque += wrench.torque;
  };
  for (const physics::Contact& contact : params_.world_info.contacts()) {
    add(contact.collision1, contact.on1);
    add(contact.collision2, contact.on2);
  }
  sink.on_reading(output_, reading);
}

}  // namespace ardee::devices
