// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/error.h"

namespace ardee {

/// An elevation model: row 0 is the upper (northern) edge.
struct Elevation {
  int width = 0;
  int height = 0;
  std::vector<float> elevations_m;  // NaN: the file has none there

  float at(int column, int row) const {
    return elevations_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(column)];
  }
};

/// Reads a TIFF of elevations: of floats, of signed or of 32-bit numbers, or of 16-bit ones with a
/// GeoTIFF's tags; any other file is a picture, and nothing is returned. Throws Error at `source`.
std::optional<Elevation> read_elevation(const std::string& path, const Source& source);

}  // namespace ardee
