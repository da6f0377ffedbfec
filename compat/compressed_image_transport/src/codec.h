// SPDX-License-Identifier: MIT
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <stdexcept>
#include <string>

namespace compressed_image_transport {

/// An image that cannot be compressed, or compressed data that are no image: what was found, what
/// was expected.
class CodecError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Options {
  std::string format = "jpeg";  ///< or "png"
  int jpeg_quality = 80;        ///< 1 to 100
  int png_level = 9;            ///< 1 (fast) to 9 (small)
};

/// Compresses mono8, rgb8, bgr8, rgba8, bgra8 and 8-bit Bayer patterns as asked, mono16 and 16UC1
/// always as PNG. Alpha is left out. Throws CodecError.
sensor_msgs::CompressedImage compress(const sensor_msgs::Image& image, const Options& options);

/// The image of a JPEG or PNG file in the encoding that `format` names, else mono8 or bgr8.
/// Throws CodecError.
sensor_msgs::Image decompress(const sensor_msgs::CompressedImage& compressed);

}  // namespace compressed_image_transport
