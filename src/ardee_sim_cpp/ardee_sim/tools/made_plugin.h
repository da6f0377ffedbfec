// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/simulation/simulation.h"

namespace ardee {

/// A plugin of the registry, made on a small robot with only the keys that it requires.
class MadePlugin {
 public:
  /// `more` is added to the plugin's element. Throws std::logic_error if the plugin cannot be made.
  MadePlugin(const std::string& file, bool in_sensor, const std::string& more = "");

  devices::Device& device() const { return *device_; }
  /// Record of the keys that it read.
  const KeyLog& keys() const { return *keys_; }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  bool make(const std::string& more);
  void add_needed();

  std::string file_;
  bool in_sensor_;
  std::map<std::string, std::string> given_;
  std::string problem_;
  std::vector<std::string> warnings_;
  std::shared_ptr<KeyLog> keys_;
  std::unique_ptr<Simulation> simulation_;
  devices::Device* device_ = nullptr;
};

}  // namespace ardee
