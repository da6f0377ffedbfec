// SPDX-License-Identifier: MIT
#include "ardee_sim/image/decoders.h"
#include "ardee_sim/image/tiff_file.h"

namespace ardee {
namespace {

/// Orientations of 1 to 4: where a file's first row and column lie.
bool starts_right(std::uint16_t orientation) { return orientation == 2 || orientation == 3; }
bool starts_low(std::uint16_t orientation) { return orientation == 3 || orientation == 4; }

std::vector<std::uint16_t> first_of_16(TiffFile& tiff, const ImageFile& file) {
  if (tiff.orientation() < 1 || tiff.orientation() > 4) {
    throw unreadable(file, "orientation " + std::to_string(tiff.orientation()) +
                               ", expected 1 to 4: rows from one side to the other");
  }
  const std::uint32_t last_column = tiff.width() - 1, last_row = tiff.height() - 1;
  const bool is_mirrored = starts_right(tiff.orientation());
  const bool is_upside_down = starts_low(tiff.orientation());
  const bool is_inverted = tiff.photometric() == PHOTOMETRIC_MINISWHITE;
  std::vector<std::uint16_t> samples(std::size_t{tiff.width()} * tiff.height());
  tiff.read_samples([&](std::uint32_t column, std::uint32_t row, double value) {
    const std::size_t x = is_mirrored ? last_column - column : column;
    const std::size_t y = is_upside_down ? last_row - row : row;
    const auto sample = static_cast<std::uint16_t>(value);
    samples[y * tiff.width() + x] =
        is_inverted ? static_cast<std::uint16_t>(65535 - sample) : sample;
  });
  return samples;
}

}  // namespace

Image decode_tiff(const ImageFile& file, Channels wanted) {
  TiffFile tiff(file.path, file.source);
  Image image = image_of(file, tiff.width(), tiff.height(), wanted);
  image.bits = tiff.bits() > 8 ? 16 : 8;
  const bool is_whole = !tiff.holds_floats() && !tiff.holds_signed();
  const bool has_brightness = tiff.photometric() <= PHOTOMETRIC_RGB;  // no palette, no inks
  if (wanted == Channels::kGray && tiff.bits() == 16 && is_whole && has_brightness) {
    image.samples16 = first_of_16(tiff, file);
  } else {
    take_colors(tiff.read_colors(), image);
  }
  return image;
}

}  // namespace ardee
