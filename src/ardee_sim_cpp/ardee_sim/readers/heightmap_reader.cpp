// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/heightmap_reader.h"

#include <cmath>

#include "ardee_sim/readers/image.h"

namespace ardee {

HeightGrid read_height_grid(const std::string& path, const Eigen::Vector3d& size_m,
                            const Source& source) {
  constexpr double kWhite = 65535.0;
  const Image image = read_gray_image(path, source);
  if (image.width < 2 || image.height < 2) {
    throw Error(source, "found " + std::to_string(image.width) + " x " +
                            std::to_string(image.height) + " pixels in '" + path +
                            "', expected at least 2 x 2 for a heightmap");
  }
  HeightGrid grid;
  grid.columns = image.width;
  grid.rows = image.height;
  grid.size_m = size_m.head<2>();
  grid.heights_m.reserve(image.samples16.size());
  const bool inverted = size_m.z() < 0.0;
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double bright = image.samples16[image.index(column, row)] / kWhite;
      const double height_m = (inverted ? 1.0 - bright : bright) * std::abs(size_m.z());
      grid.heights_m.push_back(static_cast<float>(height_m));
    }
  }
  return grid;
}

}  // namespace ardee
