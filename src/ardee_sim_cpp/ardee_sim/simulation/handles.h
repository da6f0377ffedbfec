// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "ardee_sim/devices/device.h"

namespace ardee {

/// Names a topic of a running robot that takes commands of type T: Simulation::command_port().
template <typename T>
struct CommandPort {
  std::string topic;
};

/// Keeps the latest reading of a topic, from when the handle is made until the last copy of it is
/// gone: Simulation::reading_port().
template <typename T>
class ReadingPort {
 private:
  friend class Simulation;
  std::shared_ptr<const std::optional<devices::Reading>> latest_;
};

/// Keeps the latest readings of some topics and passes all on.
class LatestReadings : public devices::ReadingSink {
 public:
  using Latest = std::optional<devices::Reading>;

  /// The reading is empty before the topic's next one of that kind.
  std::shared_ptr<const Latest> keep(const std::string& topic, std::size_t kind);
  /// Empties all that is kept: what comes next is another run.
  void clear();
  using Saved = std::map<std::string, devices::Reading>;  // by topic
  Saved save() const;
  /// Replaces all that is kept by the saved readings.
  void restore(const Saved& saved);
  void hand_on_to(devices::ReadingSink* sink) { next_ = sink; }
  /// Whether there is a receiver of an output's readings.
  bool wants(const devices::Output& output) const;
  void on_reading(const devices::Output& output, const devices::Reading& reading) override;

 private:
  struct Kept {
    std::size_t kind;
    std::weak_ptr<Latest> latest;
  };
  std::map<std::string, Kept> kept_;
  devices::ReadingSink* next_ = nullptr;
};

}  // namespace ardee
