// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace ardee {

/// Cuts a polygon, which need not be convex, into triangles of its corners, turned as it is.
/// Corners off its plane are cut as their shadows on it are. A polygon without area has no
/// triangles. `work`, if given, grows by how many corners were compared: for a polygon that is not
/// convex up to the third power of their number.
std::vector<std::array<std::uint32_t, 3>> cut_polygon(const std::vector<Eigen::Vector3f>& corners,
                                                      std::uint64_t* work = nullptr);

}  // namespace ardee
