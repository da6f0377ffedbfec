// SPDX-License-Identifier: MIT
#include "ardee_sim/controllers/pid.h"

#include <algorithm>
#include <cmath>

#include "ardee_sim/core/error.h"

namespace ardee::control {

PidGains read_pid_gains(const Setting& group, Log& log) {
  PidGains gains;
  gains.p = group.number("p");
  gains.i = group.number("i", 0.0);
  gains.d = group.number("d", 0.0);
  const double i_clamp = std::abs(group.number("i_clamp", 0.0));
  gains.i_clamp_min = group.number("i_clamp_min", -i_clamp);
  gains.i_clamp_max = group.number("i_clamp_max", i_clamp);
  if (gains.i_clamp_min > gains.i_clamp_max) {
    throw Error(group.at("i_clamp_min").path() +
                ": found more than i_clamp_max, expected at most it");
  }
  gains.antiwindup = group.boolean("antiwindup", false);
  if (group.boolean("publish_state", false)) {
    log.warn(group.at("publish_state").path() + " has no effect: a PID's state is not published");
  }
  return gains;
}

double Pid::update(double error, double dt_s) {
  if (dt_s <= 0.0 || !std::isfinite(error)) return 0.0;
  const double rate = (error - last_error_) / dt_s;
  last_error_ = error;
  return update(error, rate, dt_s);
}

double Pid::update(double error, double error_rate, double dt_s) {
  if (dt_s <= 0.0 || !std::isfinite(error) || !std::isfinite(error_rate)) return 0.0;
  integral_ += error * dt_s;
  if (gains_.antiwindup && gains_.i != 0.0) {
    const auto [low, high] =
        std::minmax({gains_.i_clamp_min / gains_.i, gains_.i_clamp_max / gains_.i});
    integral_ = std::clamp(integral_, low, high);
  }
  const double i_term = std::clamp(gains_.i * integral_, gains_.i_clamp_min, gains_.i_clamp_max);
  return gains_.p * error + i_term + gains_.d * error_rate;
}

void Pid::reset() {
  last_error_ = 0.0;
  integral_ = 0.0;
}

devices::ParameterGroup Pid::tuning(const std::string& name) {
  using Tunable = devices::TunableParameter;
  constexpr double kMostP = 1e5;
  constexpr double kMostD = 1e3;
  const auto number = [this](const char* gain, const char* description, double PidGains::*member,
                             double low, double high) {
    const auto get = [this, member] { return gains_.*member; };
    const auto set = [this, member](double value) { gains_.*member = value; };
    return Tunable{gain, description, Tunable::Type::kDouble, low, high, get(), get, set};
  };
  return {name,
          {number("p", "Proportional gain.", &PidGains::p, -kMostP, kMostP),
           number("i", "Integral gain.", &PidGains::i, -kMostP, kMostP),
           number("d", "Derivative gain.", &PidGains::d, -kMostD, kMostD),
           number("i_clamp_min", "Min bounds for the integral windup", &PidGains::i_clamp_min,
                  -kMostP, 0.0),
           number("i_clamp_max", "Max bounds for the integral windup", &PidGains::i_clamp_max, 0.0,
                  kMostP),
           {"antiwindup", "Antiwindup.", Tunable::Type::kBool, 0.0, 1.0,
            gains_.antiwindup ? 1.0 : 0.0, [this] { return gains_.antiwindup ? 1.0 : 0.0; },
            [this](double value) { gains_.antiwindup = value != 0.0; }}}};
}

}  // namespace ardee::control
