// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/heightmap_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ardee_sim/image/image.h"
#include "ardee_sim/readers/elevation.h"

namespace ardee {
namespace {

constexpr double kWhite = 65535.0;
constexpr int kOneOf255 = 257;  // of kWhite

/// Heights as shares of the greatest height, row by row from the upper edge.
struct Shares {
  int width = 0;
  int height = 0;
  std::vector<double> of_highest;
};

Shares shares_of(const Image& image) {
  int full = static_cast<int>(kWhite);
  if (image.bits == 8) {
    const int brightest = *std::max_element(image.samples16.begin(), image.samples16.end());
    // Gazebo takes a colour of 1 for full white: corn rows are drawn in this way. 0: all black.
    if (brightest > kOneOf255) full = brightest;
  }
  Shares shares{image.width, image.height, {}};
  shares.of_highest.reserve(image.samples16.size());
  for (const std::uint16_t sample : image.samples16)
    shares.of_highest.push_back(sample / double(full));
  return shares;
}

Shares shares_of(const Elevation& elevation, const std::string& path, const Source& source,
                 Log& log) {
  float least_m = std::numeric_limits<float>::infinity();
  float greatest_m = -least_m;
  std::size_t unknown = 0;
  for (const float elevation_m : elevation.elevations_m) {
    if (std::isnan(elevation_m)) ++unknown;
    // A comparison with NaN is false.
    if (elevation_m < least_m) least_m = elevation_m;
    if (elevation_m > greatest_m) greatest_m = elevation_m;
  }
  if (unknown == elevation.elevations_m.size()) {
    throw Error(source, "found no elevations in '" + path + "', expected some");
  }
  if (unknown > 0) {
    log.warn(source.to_string() + ": " + std::to_string(unknown) + " pixels of '" + path +
             "' have no elevation, the least of the others is used");
  }
  const double span_m = static_cast<double>(greatest_m) - static_cast<double>(least_m);
  Shares shares{elevation.width, elevation.height, {}};
  shares.of_highest.reserve(elevation.elevations_m.size());
  for (const float elevation_m : elevation.elevations_m) {
    const bool lies_above = elevation_m > least_m;
    const double above_m = static_cast<double>(elevation_m) - static_cast<double>(least_m);
    shares.of_highest.push_back(lies_above ? above_m / span_m : 0.0);
  }
  return shares;
}

}  // namespace

HeightGrid read_height_grid(const std::string& path, const Eigen::Vector3d& size_m,
                            const Source& source, Log& log) {
  const std::optional<Elevation> elevation = read_elevation(path, source);
  const Shares shares = elevation ? shares_of(*elevation, path, source, log)
                                  : shares_of(read_gray_image(path, source));
  if (shares.width < 2 || shares.height < 2) {
    throw Error(source, "found " + std::to_string(shares.width) + " x " +
                            std::to_string(shares.height) + " pixels in '" + path +
                            "', expected at least 2 x 2 for a heightmap");
  }
  HeightGrid grid;
  grid.columns = shares.width;
  grid.rows = shares.height;
  grid.size_m = size_m.head<2>();
  grid.heights_m.reserve(shares.of_highest.size());
  const bool inverted = size_m.z() < 0.0;
  for (int row = grid.rows - 1; row >= 0; --row) {
    for (int column = 0; column < grid.columns; ++column) {
      const double share =
          shares.of_highest[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                            static_cast<std::size_t>(column)];
      const double height_m = (inverted ? 1.0 - share : share) * std::abs(size_m.z());
      grid.heights_m.push_back(static_cast<float>(height_m));
    }
  }
  return grid;
}

}  // namespace ardee
