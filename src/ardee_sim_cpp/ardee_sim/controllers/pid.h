// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/setting.h"
#include "ardee_sim/devices/ports.h"

namespace ardee::control {

/// Gains of a Pid. The integral's share of the command lies within i_clamp_min and i_clamp_max; it
/// is 0 as long as both are 0.
struct PidGains {
  double p = 0.0;
  double i = 0.0;
  double d = 0.0;
  double i_clamp_min = 0.0;
  double i_clamp_max = 0.0;
  bool antiwindup = false;  // bounds the integral itself, not only its share
};

/// Reads the gains in a group {p, i, d, i_clamp, i_clamp_min, i_clamp_max, antiwindup};
/// `publish_state` is a warning. Throws Error if p is missing, or a value has another type.
PidGains read_pid_gains(const Setting& group, Log& log);

/// PID law of one number as control_toolbox's Pid: p e + i integral(e) + d de/dt.
class Pid {
 public:
  explicit Pid(const PidGains& gains) : gains_(gains), initial_gains_(gains) {}

  /// The command for an error whose rate follows from the last one, 0 after a reset. It is 0 for a
  /// dt of 0 or an error that is not finite, and then the state does not change.
  double update(double error, double dt_s);
  double update(double error, double error_rate, double dt_s);
  /// Forgets the past errors; the gains stay.
  void reset();
  void serialize(StateArchive& state) { state(gains_, last_error_, integral_); }

  const PidGains& gains() const { return gains_; }
  void restore_gains() { gains_ = initial_gains_; }
  /// The gains as a dynamic_reconfigure group. The Pid outlives it.
  devices::ParameterGroup tuning(const std::string& name);

 private:
  PidGains gains_;
  PidGains initial_gains_;
  double last_error_ = 0.0;
  double integral_ = 0.0;
};

}  // namespace ardee::control
