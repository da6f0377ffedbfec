// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/devices/device.h"

namespace ardee::python {

/// Keeps the last readings of the demanded topics until Python fetches them.
class Inbox : public devices::ReadingSink {
 public:
  using Item = std::shared_ptr<const devices::Reading>;

  /// Keeps up to `keep` readings of a topic from now on.
  void demand(const std::string& topic, std::size_t keep);
  /// Keeps what is there, and takes no more.
  void undemand(const std::string& topic) { boxes_.at(topic).is_open = false; }
  bool demands(const std::string& topic) const { return knows(topic) && boxes_.at(topic).is_open; }
  /// Whether the topic was ever demanded.
  bool knows(const std::string& topic) const { return boxes_.count(topic) > 0; }
  /// Returns the last reading since the last clear(), or null. Throws std::out_of_range if nobody
  /// demanded the topic, as do the next two.
  Item latest(const std::string& topic) const { return boxes_.at(topic).latest; }
  /// Returns the readings since the last call, in the order of time.
  std::vector<Item> drain(const std::string& topic);
  /// Returns the number of readings that were lost because nobody fetched them.
  std::size_t dropped(const std::string& topic) const { return boxes_.at(topic).dropped; }
  /// Forgets all readings.
  void clear();
  void on_reading(const devices::Output& output, const devices::Reading& reading) override;

 private:
  struct Box {
    bool is_open = true;
    std::size_t keep = 1;
    std::size_t dropped = 0;
    std::deque<Item> waiting;
    Item latest;
  };
  std::map<std::string, Box> boxes_;
};

}  // namespace ardee::python
