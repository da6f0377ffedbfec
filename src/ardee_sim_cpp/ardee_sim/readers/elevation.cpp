// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/elevation.h"

#include <cmath>
#include <fstream>
#include <limits>

#include "ardee_sim/image/image.h"
#include "ardee_sim/image/tiff_file.h"

namespace ardee {
namespace {

/// A larger number is never an elevation, even if the file does not mark it as "no data".
constexpr double kAbsurd_m = 1e5;

bool is_tiff(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  char head[4] = {};
  stream.read(head, sizeof(head));
  const std::string magic(head, sizeof(head));
  for (const char version : {'\x2a', '\x2b'}) {  // classic and big
    if (magic == std::string{'I', 'I', version, '\0'}) return true;
    if (magic == std::string{'M', 'M', '\0', version}) return true;
  }
  return false;
}

bool holds_elevations(const TiffFile& file) {
  return file.holds_floats() || file.holds_signed() || file.bits() == 32 ||
         (file.bits() == 16 && file.has_geo_keys());
}

}  // namespace

std::optional<Elevation> read_elevation(const std::string& path, const Source& source) {
  if (!is_tiff(path)) return std::nullopt;
  TiffFile file(path, source);
  if (!holds_elevations(file)) return std::nullopt;
  check_image_size(file.width(), file.height(), path, source);
  if (file.orientation() != ORIENTATION_TOPLEFT) {
    throw Error(source, "found elevations of orientation " + std::to_string(file.orientation()) +
                            " in '" + path + "', expected 1 (rows from the top, from the left)");
  }
  Elevation made;
  made.width = static_cast<int>(file.width());
  made.height = static_cast<int>(file.height());
  made.elevations_m.resize(std::size_t{file.width()} * file.height());
  const double no_data = file.no_data_value();
  file.read_samples([&](std::uint32_t column, std::uint32_t row, double value) {
    const bool known = std::abs(value) < kAbsurd_m && value != no_data;
    made.elevations_m[std::size_t{row} * file.width() + column] =
        known ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
  });
  return made;
}

}  // namespace ardee
