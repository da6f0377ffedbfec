// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/device.h"

#include <sstream>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/limits.h"

namespace ardee {

Output& Device::add_output(const std::string& topic, std::size_t kind) {
  outputs_.push_back({topic, kind});
  return outputs_.back();
}

void Device::add_input(const std::string& topic, std::function<void(const Twist&)> on_command) {
  inputs_.push_back({topic, [topic, act = std::move(on_command)](const Twist& command) {
                       if (!command.linear.allFinite() || !command.angular.allFinite()) {
                         throw Error(topic + ": found a command that is not finite");
                       }
                       act(command);
                     }});
}

void Device::add_number_input(NumberInput input) {
  input.on_number = [topic = input.topic, low = input.low, high = input.high,
                     act = std::move(input.on_number)](double number) {
    if (!(number >= low && number <= high)) {
      std::ostringstream text;
      text << topic << ": found " << number << ", expected a number in [" << low << ", " << high
           << "]";
      throw Error(text.str());
    }
    act(number);
  };
  number_inputs_.push_back(std::move(input));
}

void Device::add_wrench_input(const std::string& topic,
                              std::function<void(const ForceTorque&)> on_wrench) {
  const auto checked = [topic, act = std::move(on_wrench)](const ForceTorque& wrench) {
    using limits::is_within, limits::kStrongest;
    if (!is_within(wrench.force, kStrongest) || !is_within(wrench.torque, kStrongest)) {
      throw Error(topic +
                  ": found a wrench with a number that is not finite or beyond 1e9, "
                  "expected less");
    }
    act(wrench);
  };
  wrench_inputs_.push_back({topic, checked});
}

void Device::add_trigger(const std::string& topic, std::function<void()> on_trigger) {
  triggers_.push_back({topic, std::move(on_trigger)});
}

void Device::add_service(const std::string& name, Service::Act act) {
  services_.push_back({name, std::move(act)});
}

void Device::add_tuning(Tuning tuning) { tunings_.push_back(std::move(tuning)); }

}  // namespace ardee
