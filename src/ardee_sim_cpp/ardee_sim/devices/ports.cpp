// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/ports.h"

#include <sstream>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/limits.h"

namespace ardee::devices {

Input& Ports::add_velocity_input(const std::string& topic, std::function<void(const Twist&)> act) {
  return add_input<Twist>(topic, [act = std::move(act)](const Twist& command) {
    if (!command.linear.allFinite() || !command.angular.allFinite()) {
      throw Error("found a command that is not finite");
    }
    act(command);
  });
}

Input& Ports::add_wrench_input(const std::string& topic,
                               std::function<void(const physics::ForceTorque&)> act) {
  return add_input<physics::ForceTorque>(topic, [act = std::move(act)](
                                                    const physics::ForceTorque& wrench) {
    using limits::is_within, limits::kStrongest;
    if (!is_within(wrench.force, kStrongest) || !is_within(wrench.torque, kStrongest)) {
      throw Error("found a wrench with a number that is not finite or beyond 1e9, expected less");
    }
    act(wrench);
  });
}

Input& Ports::add_number_input(const std::string& topic, double low, double high,
                               std::function<void(double)> act) {
  Input& input = add_input<double>(topic, [low, high, act = std::move(act)](double number) {
    if (!(number >= low && number <= high)) {
      std::ostringstream text;
      text << "found " << number << ", expected a number in [" << low << ", " << high << "]";
      throw Error(text.str());
    }
    act(number);
  });
  input.low = low;
  input.high = high;
  return input;
}

}  // namespace ardee::devices
