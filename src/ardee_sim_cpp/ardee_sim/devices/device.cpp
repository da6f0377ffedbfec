// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/device.h"

namespace ardee {

Output& Device::add_output(const std::string& topic, std::size_t kind) {
  outputs_.push_back({topic, kind});
  return outputs_.back();
}

void Device::add_input(const std::string& topic, std::function<void(const Twist&)> on_command) {
  inputs_.push_back({topic, std::move(on_command)});
}

void Device::add_number_input(NumberInput input) { number_inputs_.push_back(std::move(input)); }

void Device::add_trigger(const std::string& topic, std::function<void()> on_trigger) {
  triggers_.push_back({topic, std::move(on_trigger)});
}

void Device::add_service(const std::string& name, Service::Act act) {
  services_.push_back({name, std::move(act)});
}

void Device::add_tuning(Tuning tuning) { tunings_.push_back(std::move(tuning)); }

}  // namespace ardee
