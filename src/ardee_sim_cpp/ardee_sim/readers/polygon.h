// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace ardee {

/// Cuts a polygon, which need not be convex, into triangles of its corners, with its orientation.
/// Corners off its plane count by their projection on it. A polygon without area has no triangles.
/// `work`, if given, grows by the number of corners compared: up to the third power of the number
/// of corners for a polygon that is not convex.
std::vector<std::array<std::uint32_t, 3>> cut_polygon(const std::vector<Eigen::Vector3f>& corners,
                                                      std::uint64_t* work = nullptr);

}  // namespace ardee
