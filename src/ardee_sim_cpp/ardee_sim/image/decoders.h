// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/image/image.h"

namespace ardee {

/// A file whose format is known by its first bytes.
struct ImageFile {
  const std::string& path;
  const Source& source;
  std::string bytes;
};

enum class Channels { kColor, kGray };  // RGBA of 8 bits, or the first channel of 16

/// Each decodes one format. Throws Error at the file's source if it is broken or too large.
Image decode_png(const ImageFile& file, Channels wanted);
Image decode_jpeg(const ImageFile& file, Channels wanted);
Image decode_tiff(const ImageFile& file, Channels wanted);
Image decode_bmp_or_tga(const ImageFile& file, Channels wanted);

/// Returns an image of this size without samples. Throws Error if it is too large.
Image image_of(const ImageFile& file, std::size_t width, std::size_t height, Channels wanted);

/// Fills an image with what it wants of RGBA of 8 bits.
void take_colors(const std::vector<std::uint8_t>& colors, Image& image);

Error unreadable(const ImageFile& file, const std::string& reason);

}  // namespace ardee
