// SPDX-License-Identifier: MIT
#include <png.h>

#include <algorithm>
#include <memory>

#include "ardee_sim/image/decoders.h"

namespace ardee {
namespace {

/// A PNG without the chunks by which a decoder would adapt samples to a screen: a heightmap's
/// samples are not brightness.
std::string without_gamma(const std::string& png) {
  constexpr std::size_t kSignature = 8;
  constexpr std::size_t kAround = 12;  // length, type and checksum of a chunk
  std::string made = png.substr(0, kSignature);
  for (std::size_t at = kSignature; at < png.size();) {
    std::size_t length = kAround;
    for (std::size_t k = 0; k < 4 && at + k < png.size(); ++k) {
      length += std::size_t{static_cast<unsigned char>(png[at + k])} << (24 - 8 * k);
    }
    const std::string type = png.substr(std::min(at + 4, png.size()), 4);
    const bool is_color = type == "gAMA" || type == "sRGB" || type == "iCCP" || type == "cHRM";
    if (!is_color) made += png.substr(at, length);
    at += length;
  }
  return made;
}

/// Samples of 16 bits, of which libpng gives colours times opacity.
std::vector<std::uint16_t> first_of_16(png_image& png, const ImageFile& file) {
  const bool has_opacity = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.format &= PNG_FORMAT_FLAG_ALPHA | PNG_FORMAT_FLAG_COLOR | PNG_FORMAT_FLAG_LINEAR;
  const std::size_t step = PNG_IMAGE_SAMPLE_CHANNELS(png.format);
  std::vector<std::uint16_t> samples(std::size_t{png.width} * png.height * step);
  if (png_image_finish_read(&png, nullptr, samples.data(), 0, nullptr) == 0) {
    throw unreadable(file, png.message);
  }
  std::vector<std::uint16_t> first;
  first.reserve(samples.size() / step);
  for (std::size_t at = 0; at < samples.size(); at += step) {
    const std::uint32_t opacity = has_opacity ? samples[at + step - 1] : 65535u;
    const std::uint32_t whole = opacity == 0 ? 0 : (samples[at] * 65535u + opacity / 2) / opacity;
    first.push_back(static_cast<std::uint16_t>(std::min(65535u, whole)));
  }
  return first;
}

}  // namespace

Image decode_png(const ImageFile& file, Channels wanted) {
  const std::string bytes = without_gamma(file.bytes);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    throw unreadable(file, png.message);
  }
  const std::unique_ptr<png_image, void (*)(png_image*)> closer(&png, &png_image_free);
  Image image = image_of(file, png.width, png.height, wanted);
  image.bits = (png.format & PNG_FORMAT_FLAG_LINEAR) != 0 ? 16 : 8;
  if (image.bits == 16 && wanted == Channels::kGray) {
    image.samples16 = first_of_16(png, file);
    return image;
  }
  png.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // as it stands, without gamma
  const bool is_gray = png.format == PNG_FORMAT_GRAY && wanted == Channels::kGray;
  png.format = is_gray ? PNG_FORMAT_GRAY : PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> samples(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, samples.data(), 0, nullptr) == 0) {
    throw unreadable(file, png.message);
  }
  if (!is_gray) {
    take_colors(samples, image);
    return image;
  }
  image.samples16.resize(samples.size());
  std::transform(samples.begin(), samples.end(), image.samples16.begin(),
                 [](std::uint8_t sample) { return static_cast<std::uint16_t>(257 * sample); });
  return image;
}

}  // namespace ardee
