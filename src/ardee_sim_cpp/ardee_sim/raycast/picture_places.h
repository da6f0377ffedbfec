// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ardee_sim/core/state_archive.h"

namespace ardee::raycast {

/// Where the local scenes of pictures lie: pictures traced in the same ones have the same bytes.
struct PicturePlaces {
  bool has_pictures = false;                                    // false: none was taken yet
  std::vector<std::pair<Eigen::Vector2d, std::uint64_t>> kept;  // centre, time of the last use
  std::optional<Eigen::Vector2d> next;
  std::uint64_t time = 0;

  void serialize(StateArchive& state) { state(has_pictures, kept, next, time); }
};

}  // namespace ardee::raycast
