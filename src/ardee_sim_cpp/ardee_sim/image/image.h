// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ardee_sim/core/error.h"

namespace ardee {

/// A decoded picture: row 0 is the upper edge, channels interleaved.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 4;                      // 4: red, green, blue, opacity; 1: brightness
  int bits = 8;                          // per channel in the file, 8 or 16
  std::vector<std::uint16_t> samples16;  // brightness of 0..65535, filled by read_gray_image
  std::vector<std::uint8_t> samples8;    // 0..255, filled by read_color_image

  std::size_t index(int column, int row) const {
    return (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(column)) *
           static_cast<std::size_t>(channels);
  }
};

/// Throws Error at `source` if an image of this size is too large to be read.
void check_image_size(std::size_t width, std::size_t height, const std::string& path,
                      const Source& source);

/// Reads PNG, JPEG, TIFF, TGA or BMP as RGBA of 8 bits. Throws Error at `source` on a missing,
/// broken or huge file.
Image read_color_image(const std::string& path, const Source& source);

/// Reads the same formats as one channel scaled to 0..65535: grey, or the first channel of a colour
/// image.
Image read_gray_image(const std::string& path, const Source& source);

/// Writes red, green and blue of a colour image; the same image gives the same bytes. Throws Error
/// and keeps an earlier file if it cannot be written.
void write_png(const std::string& path, const Image& image);

}  // namespace ardee
