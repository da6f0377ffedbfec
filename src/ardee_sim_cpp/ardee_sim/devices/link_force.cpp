// SPDX-License-Identifier: MIT
#include <string>

#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {
namespace {

/// libgazebo_ros_f3d.so: the contact force on a link, and its torque about the centre of mass of
/// the link's rigid body, after each step. Both are in the world's axes; <frameName> does not
/// change that. (The stock plugin reads the engine's sum of applied forces, which the step has set
/// to zero.)
class LinkForce : public Sensor {
 public:
  struct Params {
    Mount mount;
    std::string topic{};
    std::string frame{};
    WorldInfo world_info{};
  };

  LinkForce(const std::string& name, const Params& params)
      : Sensor(name, params.mount),
        params_(params),
        scope_(params.mount.robot.name() +
               "::" + params.mount.robot.model().links[params.mount.link].name + "::"),
        output_(add_output(params.topic, reading_kind<WrenchReading>(), params.frame)) {}

  void observe(TimeNs /*now_ns*/) override {
    if (output_.demanded) params_.world_info.want_contacts();
  }

 protected:
  void sample(TimeNs now_ns, const CounterRng& /*noise*/, ReadingSink& sink) override {
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
  bool wanted() const override { return output_.demanded; }

 private:
  Params params_;
  std::string scope_;  // of the link's collisions
  Output& output_;
};

}  // namespace

std::unique_ptr<Device> make_link_force(const PluginDescription& plugin, Parameters& parameters,
                                        DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  const std::string body = parameters.required_text("bodyName");
  const std::size_t link = context.link_index(body, parameters.block("bodyName")->source);
  LinkForce::Params params{{context.robot, link, {}, 0.0, context.seed}};
  params.topic = resolve_topic(parameters.required_text("topicName"), space);
  params.frame = resolve_frame(parameters.text("frameName", "world"), space, context);
  params.world_info = context.world_info;
  parameters.ignore({"alwaysOn", "updateRate"});
  return std::make_unique<LinkForce>(plugin.name, params);
}

}  // namespace ardee::devices
