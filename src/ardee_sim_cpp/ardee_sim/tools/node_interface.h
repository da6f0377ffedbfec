// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace ardee {

/// A service or topic of the node `simulator`, which exists in every world.
struct NodeService {
  std::string name;
  std::string type;
  std::string note;
};
struct NodeTopic {
  std::string name;
  std::string type;
  bool is_published;  // false: subscribed to
  std::string note;
};

/// tests/test_support_page.py compares both lists with a running node.
const std::vector<NodeService>& node_services();
const std::vector<NodeTopic>& node_topics();

}  // namespace ardee
