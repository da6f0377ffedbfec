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
  std::vector<float> elevations_m;  // NaN: no data in the file

  float at(int column, int row) const {
    return elevations_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(column)];
  }
};

/// Reads a TIFF of elevations: floats, signed or 32-bit integers, or 16-bit integers with GeoTIFF
/// tags. Returns nothing for any other file, which is a picture. Throws Error at `source`.
std::optional<Elevation> read_elevation(const std::string& path, const Source& source);

}  // namespace ardee
