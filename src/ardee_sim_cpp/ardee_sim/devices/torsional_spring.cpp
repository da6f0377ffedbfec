// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <sstream>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

/// libTorsionalSpringPlugin.so (thesis 4.4.3, Listings A.4, A.26, A.27): a torsional harmonic
/// oscillator on a joint, tau = -damping * rate - stiffness * (angle - reference) (eq. 4.1), with
/// the joint's limits enforced. A command on <referenceTopic> moves the reference. Unlike the
/// listing's explicit torque it is integrated implicitly and so is stable for any stiffness and
/// step.
class TorsionalSpring : public Device {
 public:
  struct Params {
    std::string joint;
    double stiffness_n_m_per_rad = 100.0;
    double damping_n_m_s_per_rad = 1.0;
    double reference_rad = 1.0;
    double lower_rad = 0.0;  // set only with has_limits
    double upper_rad = 0.0;
    bool has_limits = false;
    bool verbose = false;
    std::string reference_topic;  // empty: the reference stays
  };

  TorsionalSpring(const std::string& name, const Params& params, std::size_t joint,
                  DeviceContext& context)
      : Device(name), params_(params), joint_(joint), robot_(context.robot), log_(context.log) {
    constexpr double kFarthest = std::numeric_limits<double>::max();
    if (!params_.reference_topic.empty()) {
      ports().add_number_input(params_.reference_topic, -kFarthest, kFarthest,
                               [this](double reference_rad) { set_reference(reference_rad); });
    }
    reset(0);
  }

  void after_step(TimeNs now_ns, ReadingSink& /*sink*/) override {
    if (!params_.verbose || !verbose_timer_.due(now_ns)) return;
    const double angle = robot_.dynamics().joint_position(joint_);
    const double rate = robot_.dynamics().joint_velocity(joint_);
    std::ostringstream text;
    text << "joint " << params_.joint << ": position " << angle << " rad, velocity " << rate
         << " rad/s, spring torque "
         << -params_.damping_n_m_s_per_rad * rate -
                params_.stiffness_n_m_per_rad * (angle - reference_rad_)
         << " N m";
    log_.info(text.str());
  }
  void reset(TimeNs /*now_ns*/) override {
    reference_rad_ = params_.reference_rad;
    physics::PhysicsModel& dynamics = robot_.dynamics();
    dynamics.set_joint_spring(
        joint_, {params_.stiffness_n_m_per_rad, params_.damping_n_m_s_per_rad, reference_rad_});
    if (params_.has_limits) dynamics.set_joint_limits(joint_, params_.lower_rad, params_.upper_rad);
    verbose_timer_.reset();
  }
  void serialize(StateArchive& state) override { state(reference_rad_, verbose_timer_); }

 private:
  void set_reference(double reference_rad) {
    reference_rad_ = params_.has_limits
                         ? std::clamp(reference_rad, params_.lower_rad, params_.upper_rad)
                         : reference_rad;
    robot_.dynamics().set_joint_spring(
        joint_, {params_.stiffness_n_m_per_rad, params_.damping_n_m_s_per_rad, reference_rad_});
  }

  Params params_;
  std::size_t joint_;
  Robot& robot_;
  Log& log_;
  double reference_rad_ = 0.0;
  RateTimer verbose_timer_{1.0};
};

}  // namespace

std::unique_ptr<Device> make_torsional_spring(const PluginDescription& plugin,
                                              Parameters& parameters, DeviceContext& context) {
  const std::string space = plugin_namespace(parameters, context);
  TorsionalSpring::Params params;
  params.joint = parameters.required_text("joint_handle");
  params.stiffness_n_m_per_rad =
      parameters.number("spring_stiffness", params.stiffness_n_m_per_rad, 0.0);
  params.damping_n_m_s_per_rad =
      parameters.number("spring_damping", params.damping_n_m_s_per_rad, 0.0);
  params.reference_rad = parameters.number("spring_reference", params.reference_rad);
  params.has_limits = parameters.has("lower_limit") || parameters.has("upper_limit");
  const double infinity = std::numeric_limits<double>::infinity();
  params.lower_rad = parameters.number("lower_limit", -infinity);
  params.upper_rad = parameters.number("upper_limit", infinity);
  if (params.lower_rad > params.upper_rad) {
    throw parameters.error("lower_limit", "expected at most <upper_limit>");
  }
  params.verbose = parameters.boolean("verbose", false);
  const std::string topic = parameters.text("referenceTopic", "");
  if (!topic.empty()) params.reference_topic = resolve_topic(topic, space);
  const std::size_t joint = context.joint_index(params.joint, plugin.element.source);
  if (!has_one_axis(context.robot.model().joints[joint].type)) {
    throw Error(plugin.element.source,
                "joint '" + params.joint +
                    "' cannot carry a spring, expected a revolute, continuous or prismatic one");
  }
  return std::make_unique<TorsionalSpring>(plugin.name, params, joint, context);
}

}  // namespace ardee::devices
