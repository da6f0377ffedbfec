// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

namespace ardee::physics {

/// The vertices of a mesh, each place once, in a tree of boxes: the tree finds those that may lie
/// below the ground without visiting the others.
class VertexTree {
 public:
  explicit VertexTree(std::vector<Eigen::Vector3f> vertices);

  /// Calls `visit` with each vertex of the boxes for which `may_touch` is true, box after box.
  template <typename MayTouch, typename Visit>
  void visit(const MayTouch& may_touch, const Visit& visit, std::size_t node = 0) const {
    if (node >= nodes_.size() || !may_touch(nodes_[node].box)) return;
    if (nodes_[node].right == 0) {
      for (std::size_t i = nodes_[node].first; i < nodes_[node].last; ++i) visit(vertices_[i]);
      return;
    }
    this->visit(may_touch, visit, node + 1);
    this->visit(may_touch, visit, nodes_[node].right);
  }

 private:
  struct Node {
    Eigen::AlignedBox3f box;
    std::size_t first, last;  // of vertices_
    std::size_t right = 0;    // of two halves the first follows the node itself; 0: not halved
  };
  void add_node(std::size_t first, std::size_t last);

  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Node> nodes_;
};

}  // namespace ardee::physics
