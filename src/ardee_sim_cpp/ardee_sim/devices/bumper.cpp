// SPDX-License-Identifier: MIT
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/core/nearest_names.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/sensor.h"

namespace ardee::devices {
namespace {

/// Name of a collision before Gazebo lumped its link into the link that it is fixed to:
/// "deck_fixed_joint_lump__guard_collision_1" was "guard_collision".
std::vector<std::string> names_before_lumping(const std::string& name) {
  const std::string mark = "_fixed_joint_lump__";
  const std::size_t at = name.rfind(mark);
  if (at == std::string::npos) return {};
  std::vector<std::string> names{name.substr(at + mark.size())};
  const std::string& last = names.back();
  const std::size_t number = last.find_last_not_of("0123456789");
  if (number != std::string::npos && number + 1 < last.size() && last[number] == '_') {
    names.push_back(last.substr(0, number));
  }
  return names;
}

bool has_collision(const Link& link, const std::string& name) {
  for (const Collision& collision : link.collisions) {
    if (collision.name == name) return true;
  }
  return false;
}

/// Scoped name of a collision of the sensor's link, or if there is none, of another link of the
/// model: Gazebo merges fixed links. Throws Error if the model has no such collision.
std::string scoped_collision(const Element& given, std::size_t link, const Robot& robot) {
  std::vector<std::string> names{given.text};
  for (const std::string& name : names_before_lumping(given.text)) names.push_back(name);
  const std::vector<Link>& links = robot.model().links;
  const auto scoped = [&robot](const Link& of, const std::string& name) {
    return robot.name() + "::" + of.name + "::" + name;
  };
  for (const std::string& name : names) {
    if (has_collision(links[link], name)) return scoped(links[link], name);
  }
  for (const std::string& name : names) {
    for (const Link& other : links) {
      if (has_collision(other, name)) return scoped(other, name);
    }
  }
  std::vector<std::string> known;
  for (const Link& each : links) {
    for (const Collision& collision : each.collisions) known.push_back(collision.name);
  }
  throw Error(given.source, "found collision '" + given.text +
                                "', expected one of: " + nearest_names(given.text, known) +
                                (known.empty() ? ", as the model has none" : ""));
}

std::set<std::string> read_collisions(const SensorDescription& sensor, std::size_t link,
                                      const Robot& robot) {
  std::set<std::string> found;
  const Element* contact = sensor.element.child("contact");
  for (const Element& child : contact ? contact->children : std::vector<Element>()) {
    if (child.name == "collision") found.insert(scoped_collision(child, link, robot));
  }
  if (found.empty()) {
    throw Error(sensor.element.source, "found no <contact> with a <collision>, expected one");
  }
  return found;
}

/// The contact as the second body feels it.
physics::Contact swapped(const physics::Contact& contact) {
  physics::Contact made = contact;
  std::swap(made.collision1, made.collision2);
  std::swap(made.on1, made.on2);
  made.normal = -contact.normal;
  return made;
}

/// libgazebo_ros_bumper.so in a sensor of type contact: contacts of the collisions that the
/// sensor's <contact> names. A message holds each step since the last one, as the stock plugin's
/// does. Its vectors are in the world's axes; <frameName> does not change that.
class Bumper : public Sensor {
 public:
  struct Params {
    Mount mount;
    std::set<std::string> collisions{};  // scoped names
    std::string topic{};
    std::string frame{};
    WorldInfo world_info{};
  };

  Bumper(const std::string& name, const Params& params)
      : Sensor(name, params.mount),
        params_(params),
        output_(add_output(params.topic, reading_kind<ContactsReading>(), params.frame)) {}

  void observe(TimeNs /*now_ns*/) override {
    if (output_.demanded) params_.world_info.want_contacts();
  }
  void reset(TimeNs now_ns) override {
    Sensor::reset(now_ns);
    touches_.clear();
  }
  void serialize(StateArchive& state) override {
    Sensor::serialize(state);
    state(touches_);
  }

 protected:
  void follow(TimeNs now_ns) override;
  void sample(TimeNs now_ns, const CounterRng& /*noise*/, ReadingSink& sink) override {
    sink.on_reading(output_, ContactsReading{{now_ns, params_.frame}, std::move(touches_)});
    touches_.clear();
  }
  bool wanted() const override { return output_.demanded; }

 private:
  Params params_;
  Output& output_;
  std::vector<ContactsReading::Touch> touches_;  // since the last sample
};

void Bumper::follow(TimeNs now_ns) {
  if (!output_.demanded) {
    touches_.clear();
    return;
  }
  for (const physics::Contact& found : params_.world_info.contacts()) {
    const bool is_first = params_.collisions.count(found.collision1) != 0;
    if (!is_first && params_.collisions.count(found.collision2) == 0) continue;
    const physics::Contact contact = is_first ? found : swapped(found);
    const auto belongs = [&](const ContactsReading::Touch& touch) {
      return touch.time_ns == now_ns && touch.collision1 == contact.collision1 &&
             touch.collision2 == contact.collision2;
    };
    if (touches_.empty() || !belongs(touches_.back())) {
      touches_.push_back({now_ns, contact.collision1, contact.collision2, {}});
    }
    touches_.back().points.push_back(contact);
  }
}

}  // namespace

std::unique_ptr<Device> make_bumper(const SensorDescription& sensor, Parameters& parameters,
                                    std::size_t link, DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  Bumper::Params params{{context.robot, link, sensor.X_LS, sensor.update_rate_hz, context.seed}};
  params.collisions = read_collisions(sensor, link, context.robot);
  params.topic = resolve_topic(parameters.text("bumperTopicName", "bumper_states"), space);
  params.frame = resolve_frame(parameters.text("frameName", "world"), space, context);
  params.world_info = context.world_info;
  parameters.ignore({"alwaysOn", "updateRate"});
  return std::make_unique<Bumper>(sensor.name, params);
}

}  // namespace ardee::devices
