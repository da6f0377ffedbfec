// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/vertex_tree.h"

#include <algorithm>

namespace ardee::physics {
namespace {

constexpr std::size_t kMostInLeaf = 16;

bool is_before(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace

VertexTree::VertexTree(std::vector<Eigen::Vector3f> vertices) : vertices_(std::move(vertices)) {
  std::sort(vertices_.begin(), vertices_.end(), is_before);
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  if (!vertices_.empty()) add_node(0, vertices_.size());
}

void VertexTree::add_node(std::size_t first, std::size_t last) {
  Node node{{}, first, last};
  for (std::size_t i = first; i < last; ++i) node.box.extend(vertices_[i]);
  const std::size_t own = nodes_.size();
  nodes_.push_back(node);
  if (last - first <= kMostInLeaf) return;
  int axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [this](std::size_t i) {
    return vertices_.begin() + static_cast<std::ptrdiff_t>(i);
  };
  std::nth_element(at(first), at(middle), at(last),
                   [axis](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
                     return a[axis] != b[axis] ? a[axis] < b[axis] : is_before(a, b);
                   });
  add_node(first, middle);
  nodes_[own].right = nodes_.size();
  add_node(middle, last);
}

}  // namespace ardee::physics
