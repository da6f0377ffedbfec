// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/device.h"

namespace ardee {

Output& Device::add_output(const std::string& topic, std::size_t kind) {
  outputs_.push_back({topic, kind, true});
  return outputs_.back();
}

void Device::add_input(const std::string& topic, std::function<void(const Twist&)> on_command) {
  inputs_.push_back({topic, std::move(on_command)});
}

}  // namespace ardee
