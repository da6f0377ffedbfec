// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace compressed_image_transport {

/// How the pixels of an encoding lie in memory.
struct Layout {
  int channels = 1;  ///< 1, 3, or 4 with alpha last
  int bits = 8;      ///< a channel: 8 or 16
  bool is_bgr = false;

  std::size_t pixel_bytes() const { return static_cast<std::size_t>(channels * bits / 8); }
  bool is_colour() const { return channels > 1; }
};

/// Rows of pixels; those of 16 bits in this computer's order of bytes, or the other one.
struct Pixels {
  const std::uint8_t* data = nullptr;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::size_t step = 0;  ///< bytes from row to row
  Layout layout;
  bool is_swapped = false;
};

std::vector<std::uint8_t> encode_png(const Pixels& pixels, int level);

/// What a PNG file says of itself; PNG's other kinds are converted to these.
struct PngHead {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Layout layout;
  std::uint64_t raw_bytes = 0;  ///< of all rows in the file's own layout
};
PngHead read_png_head(const std::vector<std::uint8_t>& file);
/// The rows, one right after the other, in the wanted layout of the head's depth.
std::vector<std::uint8_t> decode_png(const std::vector<std::uint8_t>& file, const Layout& wanted);

}  // namespace compressed_image_transport
