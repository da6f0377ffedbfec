// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/clustering.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace ardee::raycast {
namespace {

/// Number of boxes above which the longest axis is halved instead of trying each cut.
constexpr std::size_t kExhaustiveLimit = 8192;

double half_area(const Bounds& box) {
  const Eigen::Vector3d size = box.upper - box.lower;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// Recursive cuts by the surface area heuristic, each at a multiple of the group size, so that
/// groups are full.
class Grouping {
 public:
  Grouping(const std::vector<Bounds>& boxes, std::uint32_t group_size,
           std::vector<std::uint32_t>& order)
      : boxes_(boxes), group_size_(group_size), order_(order), area_(boxes.size()) {}

  void cut(std::size_t begin, std::size_t end, std::vector<std::uint32_t>& starts) {
    if (end - begin <= group_size_) {
      starts.push_back(static_cast<std::uint32_t>(begin));
      return;
    }
    const std::size_t middle =
        end - begin > kExhaustiveLimit ? halve(begin, end) : best_cut(begin, end);
    cut(begin, middle, starts);
    cut(middle, end, starts);
  }

 private:
  void sort(std::size_t begin, std::size_t end, int axis) {
    std::sort(order_.begin() + static_cast<std::ptrdiff_t>(begin),
              order_.begin() + static_cast<std::ptrdiff_t>(end), [&](auto a, auto b) {
                const double ca = boxes_[a].lower[axis] + boxes_[a].upper[axis];
                const double cb = boxes_[b].lower[axis] + boxes_[b].upper[axis];
                return ca != cb ? ca < cb : a < b;
              });
  }

  std::size_t halve(std::size_t begin, std::size_t end) {
    Bounds centers;
    for (std::size_t i = begin; i < end; ++i) centers.add(boxes_[order_[i]].center());
    int axis = 0;
    (centers.upper - centers.lower).maxCoeff(&axis);
    sort(begin, end, axis);
    const std::size_t groups = (end - begin + group_size_ - 1) / group_size_;
    return begin + groups / 2 * group_size_;
  }

  double groups(std::size_t count) const {
    return static_cast<double>((count + group_size_ - 1) / group_size_);
  }

  std::size_t best_cut(std::size_t begin, std::size_t end) {
    double best = std::numeric_limits<double>::infinity();
    int best_axis = 0;
    std::size_t best_middle = begin + group_size_;
    for (int axis = 0; axis < 3; ++axis) {
      sort(begin, end, axis);
      Bounds right;
      for (std::size_t i = end; i-- > begin;) {
        right.add(boxes_[order_[i]]);
        area_[i] = half_area(right);
      }
      Bounds left;
      for (std::size_t i = begin; i + 1 < end; ++i) {
        left.add(boxes_[order_[i]]);
        const std::size_t count = i + 1 - begin;
        if (count % group_size_ != 0) continue;
        const double cost =
            half_area(left) * groups(count) + area_[i + 1] * groups(end - begin - count);
        if (cost < best) {
          best = cost;
          best_axis = axis;
          best_middle = i + 1;
        }
      }
    }
    sort(begin, end, best_axis);
    return best_middle;
  }

  const std::vector<Bounds>& boxes_;
  const std::size_t group_size_;
  std::vector<std::uint32_t>& order_;
  std::vector<double> area_;
};

}  // namespace

std::vector<std::uint32_t> group_boxes(const std::vector<Bounds>& boxes, std::uint32_t group_size,
                                       std::vector<std::uint32_t>& order) {
  order.resize(boxes.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::uint32_t> starts;
  if (!boxes.empty()) Grouping(boxes, group_size, order).cut(0, boxes.size(), starts);
  starts.push_back(static_cast<std::uint32_t>(boxes.size()));
  return starts;
}

}  // namespace ardee::raycast
