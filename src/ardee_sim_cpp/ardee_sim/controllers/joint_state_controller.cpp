// SPDX-License-Identifier: MIT
#include <algorithm>
#include <vector>

#include "ardee_sim/controllers/controller.h"
#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/core/error.h"
#include "ardee_sim/devices/names.h"

namespace ardee::control {
namespace {

double exact_double(const Setting& extra_joint, const std::string& key, const std::string& place) {
  const Setting setting = extra_joint.at(key);
  if (!setting) return 0.0;
  if (const auto* number = std::get_if<double>(&setting.value())) return *number;
  throw Error(place + "/" + key + ": expected a number with a point, as 0.0");
}

/// joint_state_controller/JointStateController: publishes the states of the hardware's joints on
/// "joint_states" of the robot.
class JointStateController : public Controller {
 public:
  explicit JointStateController(const ControllerContext& context);

  void start(TimeNs now_ns) override {
    constexpr double kPeriodsAgo = 1.001;  // the first update publishes
    const bool publishes = timer_.rate_hz() > 0.0;
    timer_.start(publishes ? now_ns - nanoseconds(kPeriodsAgo / timer_.rate_hz()) : now_ns);
  }
  void update(TimeNs now_ns, double /*period_s*/, devices::ReadingSink& sink) override {
    if (!timer_.due(now_ns) || !output_.demanded) return;
    reading_.header.stamp_ns = now_ns;
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      reading_.positions[i] = joints_[i]->position;
      reading_.velocities[i] = joints_[i]->velocity;
      reading_.efforts[i] = joints_[i]->effort;
    }
    sink.on_reading(output_, reading_);
  }
  void reset(TimeNs now_ns) override { start(now_ns); }
  void serialize(StateArchive& state) override { state(timer_); }

 private:
  void add_extra_joints(const ControllerContext& context);

  std::vector<const JointHandle*> joints_;
  devices::JointStateReading
      reading_;  // joints of the hardware first, then those that never change
  PublishTimer timer_;
  devices::Output& output_;
};

JointStateController::JointStateController(const ControllerContext& context)
    : timer_(context.settings.number("publish_rate")),
      output_(ports().add_output(devices::resolve_topic("joint_states", context.robot_namespace),
                                 devices::reading_kind<devices::JointStateReading>())) {
  if (context.settings.has("joints")) {
    for (const std::string& name : context.settings.texts("joints")) {
      const auto found = context.hardware.find(name);
      if (found == context.hardware.end()) {
        throw Error(context.settings.at("joints").path() + ": found joint '" + name +
                    "', expected one that a transmission names");
      }
      joints_.push_back(&found->second);
    }
  } else {
    for (const auto& [name, joint] : context.hardware) joints_.push_back(&joint);
  }
  for (const JointHandle* joint : joints_) reading_.names.push_back(joint->name);
  reading_.positions.resize(joints_.size());
  reading_.velocities.resize(joints_.size());
  reading_.efforts.resize(joints_.size());
  add_extra_joints(context);
}

void JointStateController::add_extra_joints(const ControllerContext& context) {
  const Setting extra = context.settings.at("extra_joints");
  if (!extra) return;
  const auto* list = std::get_if<Setting::List>(&extra.value());
  if (!list) throw Error(extra.path() + ": expected a list of groups, each with a name");
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Setting& joint = (*list)[i];
    const std::string place = extra.path() + "[" + std::to_string(i) + "]";
    const Setting given = joint.at("name");
    const auto* name = std::get_if<std::string>(&given.value());
    if (!name) throw Error(place + "/name: expected the name of a joint");
    if (std::count(reading_.names.begin(), reading_.names.end(), *name) > 0) {
      context.log.warn(place + ": found joint '" + *name +
                       "', expected one that is not published yet: it is published twice");
    }
    reading_.names.push_back(*name);
    reading_.positions.push_back(exact_double(joint, "position", place));
    reading_.velocities.push_back(exact_double(joint, "velocity", place));
    reading_.efforts.push_back(exact_double(joint, "effort", place));
  }
}

}  // namespace

std::unique_ptr<Controller> make_joint_state(const ControllerContext& context) {
  return std::make_unique<JointStateController>(context);
}

}  // namespace ardee::control
