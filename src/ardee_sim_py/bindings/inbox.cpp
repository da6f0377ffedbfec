// SPDX-License-Identifier: MIT
#include "inbox.h"

namespace ardee::python {

void Inbox::demand(const std::string& topic, std::size_t keep) {
  Box& box = boxes_[topic];
  box.keep = keep;
  box.is_open = true;
  while (box.waiting.size() > keep) box.waiting.pop_front();
}

std::vector<Inbox::Item> Inbox::drain(const std::string& topic) {
  Box& box = boxes_.at(topic);
  const std::vector<Item> items(box.waiting.begin(), box.waiting.end());
  box.waiting.clear();
  return items;
}

void Inbox::clear() {
  for (auto& [topic, box] : boxes_) {
    box.waiting.clear();
    box.latest.reset();
    box.dropped = 0;
  }
}

void Inbox::on_reading(const devices::Output& output, const devices::Reading& reading) {
  const auto found = boxes_.find(output.topic);
  if (found == boxes_.end() || !found->second.is_open) return;
  Box& box = found->second;
  box.latest = std::make_shared<const devices::Reading>(reading);
  box.waiting.push_back(box.latest);
  if (box.waiting.size() <= box.keep) return;
  box.waiting.pop_front();
  if (box.keep > 1) ++box.dropped;
}

}  // namespace ardee::python
