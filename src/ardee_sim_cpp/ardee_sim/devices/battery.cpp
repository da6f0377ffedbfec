// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/drive_command.h"
#include "ardee_sim/devices/makers.h"
#include "ardee_sim/devices/names.h"

namespace ardee::devices {
namespace {

constexpr double kSecondsPerHour = 3600.0;
constexpr double kNotModelled = std::numeric_limits<double>::quiet_NaN();

/// libardee_ros_battery.so (thesis 4.3.1, Listings A.8, A.12), in two modes. Quick: the voltage
/// falls by a fixed amount each update, to test within seconds how an algorithm reacts to a low
/// battery. Current-driven, if <constantCoef> is given: the drive command draws a current, and the
/// voltage follows the linear model of Gazebo's LinearBatteryPlugin,
///   V = constant + linear (1 - q / capacity) - resistance i,
/// where i is the current smoothed with a time constant and q the charge left.
class Battery : public Device {
 public:
  struct Params {
    double rate_hz = 100.0;
    double capacity_Ah = 5.2;
    double initial_charge_Ah = 5.2;
    double voltage_max_V = 16.0;
    double voltage_min_V = 2.0;
    // quick mode
    double voltage_initial_V = 14.0;
    double voltage_drop_V = 0.01;  // each update
    // current-driven mode
    bool current_driven = false;
    double constant_V = 12.694;
    double linear_V = -100.1424;
    double resistance_ohm = 0.061523;
    double smoothing_s = 1.9499;
    double idle_current_A = 1.0;        // nominal, as the two below
    double current_per_speed = 4.0;     // A per m/s
    double current_per_yaw_rate = 2.0;  // A per rad/s
    std::string command_topic;
    std::string topic;
    std::string state_topic;
    std::string frame;
    std::string name;
  };

  Battery(const std::string& name, const Params& params)
      : Device(name),
        params_(params),
        timer_(params.rate_hz),
        output_(
            add_output(params.topic, reading_kind<BatteryReading>(), params.rate_hz, params.frame)),
        state_output_(add_output(params.state_topic, reading_kind<BatteryStateReading>(),
                                 params.rate_hz, params.frame)) {
    if (params_.current_driven) {
      ports().add_velocity_input(params_.command_topic,
                                 [this](const Twist& command) { command_.set(command); });
    }
    reset(0);
  }

  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override {
    timer_.start_at(now_ns + 1);
    last_ns_ = now_ns;
    command_.reset(now_ns);
    quick_voltage_V_ = params_.voltage_initial_V;
    charge_Ah_ = params_.initial_charge_Ah;
    current_A_ = params_.idle_current_A;
  }
  void serialize(StateArchive& state) override {
    state(timer_, command_, last_ns_, quick_voltage_V_, charge_Ah_, current_A_);
  }

 private:
  void discharge(double elapsed_s, const Twist& command) {
    const double wanted_A = params_.idle_current_A +
                            params_.current_per_speed * std::abs(command.linear.x()) +
                            params_.current_per_yaw_rate * std::abs(command.angular.z());
    // The exact answer of a first-order lag to a current that is constant over the interval.
    const double share =
        params_.smoothing_s > 0.0 ? -std::expm1(-elapsed_s / params_.smoothing_s) : 1.0;
    const double before_A = current_A_;
    current_A_ += share * (wanted_A - current_A_);
    const double used_Ah = 0.5 * (before_A + current_A_) * elapsed_s / kSecondsPerHour;
    charge_Ah_ = std::max(0.0, charge_Ah_ - used_Ah);
  }
  /// Terminal voltage within the battery's bounds.
  double voltage_V() const {
    const double free_V = params_.current_driven
                              ? params_.constant_V +
                                    params_.linear_V * (1.0 - charge_Ah_ / params_.capacity_Ah) -
                                    params_.resistance_ohm * current_A_
                              : quick_voltage_V_;
    return std::clamp(free_V, params_.voltage_min_V, params_.voltage_max_V);
  }
  BatteryStateReading state() const;

  Params params_;
  RateTimer timer_;
  DriveCommand command_{0.0};
  TimeNs last_ns_ = 0;
  double quick_voltage_V_ = 0.0;
  double charge_Ah_ = 0.0;
  double current_A_ = 0.0;  // smoothed, out of the battery
  Output& output_;
  Output& state_output_;
};

void read_current_model(Parameters& parameters, Battery::Params& params) {
  params.constant_V = parameters.number("constantCoef", params.constant_V);
  params.linear_V = parameters.number("linearCoef", params.linear_V);
  params.resistance_ohm = parameters.number("internalResistance", params.resistance_ohm, 0.0);
  params.smoothing_s = parameters.number("smoothCurrentTau", params.smoothing_s, 0.0);
  params.idle_current_A = parameters.number("idleCurrent", params.idle_current_A, 0.0);
  params.current_per_speed = parameters.number("currentPerSpeed", params.current_per_speed, 0.0);
  params.current_per_yaw_rate =
      parameters.number("currentPerYawRate", params.current_per_yaw_rate, 0.0);
}

void require_order(Parameters& parameters, const Battery::Params& params) {
  if (params.voltage_min_V >= params.voltage_max_V) {
    throw parameters.error("vMin", "expected less than <vMax>");
  }
  if (params.voltage_initial_V < params.voltage_min_V ||
      params.voltage_initial_V > params.voltage_max_V) {
    throw parameters.error("vInitial", "expected between <vMin> and <vMax>");
  }
  if (params.initial_charge_Ah > params.capacity_Ah) {
    throw parameters.error("initialCharge", "expected at most <capacity>");
  }
}

BatteryStateReading Battery::state() const {
  BatteryStateReading reading;
  reading.voltage_V = voltage_V();
  reading.design_capacity_Ah = params_.capacity_Ah;
  reading.location = params_.name;
  if (params_.current_driven) {
    reading.current_A = -current_A_;
    reading.charge_Ah = charge_Ah_;
    reading.capacity_Ah = params_.capacity_Ah;
    reading.percentage = charge_Ah_ / params_.capacity_Ah;
  } else {
    reading.current_A = reading.charge_Ah = reading.capacity_Ah = kNotModelled;
    reading.percentage = (reading.voltage_V - params_.voltage_min_V) /
                         (params_.voltage_max_V - params_.voltage_min_V);
  }
  return reading;
}

void Battery::after_step(TimeNs now_ns, ReadingSink& sink) {
  if (!timer_.due(now_ns)) return;
  if (params_.current_driven) {
    discharge(seconds(now_ns - last_ns_), command_.at(now_ns));
  } else {
    quick_voltage_V_ = std::max(params_.voltage_min_V, quick_voltage_V_ - params_.voltage_drop_V);
  }
  last_ns_ = now_ns;
  const Header header{now_ns, params_.frame};
  if (output_.demanded) {
    sink.on_reading(
        output_, BatteryReading{header, voltage_V(), params_.voltage_max_V, params_.voltage_min_V});
  }
  if (state_output_.demanded) {
    BatteryStateReading reading = state();
    reading.header = header;
    sink.on_reading(state_output_, reading);
  }
}

}  // namespace

std::unique_ptr<Device> make_battery(const PluginDescription& plugin, Parameters& parameters,
                                     DeviceContext& context) {
  constexpr double kLowestRate_hz = 1e-3;
  constexpr double kSmallest = 1e-9;
  const std::string space = plugin_namespace(parameters, context);
  Battery::Params params;
  params.rate_hz = parameters.number("updateRate", params.rate_hz, kLowestRate_hz);
  params.capacity_Ah = parameters.number("capacity", params.capacity_Ah, kSmallest);
  params.initial_charge_Ah = parameters.number("initialCharge", params.capacity_Ah, 0.0);
  params.voltage_max_V = parameters.number("vMax", params.voltage_max_V);
  params.voltage_min_V = parameters.number("vMin", params.voltage_min_V);
  params.voltage_initial_V = parameters.number("vInitial", params.voltage_initial_V);
  params.voltage_drop_V = parameters.number("deltaVoltage", params.voltage_drop_V, 0.0);
  require_order(parameters, params);
  params.current_driven = parameters.has("constantCoef");
  read_current_model(parameters, params);
  params.command_topic = resolve_topic(parameters.text("commandTopic", "cmd_vel"), space);
  const std::string topic = parameters.text("batteryTopic", "ardee/battery");
  params.topic = resolve_topic(topic, space);
  params.state_topic = resolve_topic(parameters.text("batteryStateTopic", topic + "_state"), space);
  params.frame = resolve_frame(parameters.text("batteryLink", "battery"), space, context);
  params.name = parameters.text("batteryName", plugin.name);
  parameters.ignore({"robotBaseFrame", "alwaysOn"});
  return std::make_unique<Battery>(plugin.name, params);
}

}  // namespace ardee::devices
