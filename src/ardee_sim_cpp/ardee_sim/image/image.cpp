// SPDX-License-Identifier: MIT
#include "ardee_sim/image/image.h"

#include <png.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/image/decoders.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxSide = 16384;
constexpr std::size_t kMaxPixels = std::size_t{1} << 26;
constexpr std::size_t kMaxFileBytes = std::size_t{1} << 29;
constexpr int kWhiteOf16 = 65535 / 255;  // of one of 8 bits

using Decoder = Image (*)(const ImageFile&, Channels);

/// The decoder for a file's first bytes.
Decoder decoder_of(const ImageFile& file) {
  const std::string& head = file.bytes;
  if (head.size() < 8) {
    throw Error(file.source, "found a truncated image '" + file.path + "', expected a whole one");
  }
  if (head.compare(0, 8, "\x89PNG\r\n\x1a\n") == 0) return &decode_png;
  if (head.compare(0, 3, "\xff\xd8\xff") == 0) return &decode_jpeg;
  const std::string four = head.substr(0, 4);
  if (four == std::string("II*\0", 4) || four == std::string("MM\0*", 4)) return &decode_tiff;
  if (head.compare(0, 2, "BM") == 0) return &decode_bmp_or_tga;
  const std::string extension = std::filesystem::path(file.path).extension().string();
  if (extension == ".tga" || extension == ".TGA") return &decode_bmp_or_tga;
  throw Error(file.source,
              "found '" + file.path + "', expected a PNG, JPEG, TIFF, TGA or BMP image");
}

Image decode(const std::string& path, const Source& source, Channels wanted) {
  const ImageFile file{path, source, read_text_file(path, source, kMaxFileBytes)};
  return decoder_of(file)(file, wanted);
}

}  // namespace

void check_image_size(std::size_t width, std::size_t height, const std::string& path,
                      const Source& source) {
  if (width == 0 || height == 0 || width > kMaxSide || height > kMaxSide ||
      width * height > kMaxPixels) {
    throw Error(source, "found an image of " + std::to_string(width) + " x " +
                            std::to_string(height) + " pixels in '" + path + "', expected 1 to " +
                            std::to_string(kMaxSide) + " a side and at most " +
                            std::to_string(kMaxPixels) + " in all");
  }
}

Image image_of(const ImageFile& file, std::size_t width, std::size_t height, Channels wanted) {
  check_image_size(width, height, file.path, file.source);
  Image image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.channels = wanted == Channels::kGray ? 1 : 4;
  return image;
}

void take_colors(const std::vector<std::uint8_t>& colors, Image& image) {
  if (image.channels == 4) {
    image.samples8 = colors;
    return;
  }
  image.samples16.reserve(colors.size() / 4);
  for (std::size_t at = 0; at < colors.size(); at += 4) {
    image.samples16.push_back(static_cast<std::uint16_t>(kWhiteOf16 * colors[at]));
  }
}

Error unreadable(const ImageFile& file, const std::string& reason) {
  return Error(file.source,
               "found '" + file.path + "', expected a readable image (" + reason + ")");
}

Image read_color_image(const std::string& path, const Source& source) {
  return decode(path, source, Channels::kColor);
}

Image read_gray_image(const std::string& path, const Source& source) {
  return decode(path, source, Channels::kGray);
}

void write_png(const std::string& path, const Image& image) {
  const Source source{path, 0, ""};
  if (image.channels != 4 || image.samples8.empty()) {
    throw Error(source, "found a picture without colours, expected one to write");
  }
  std::vector<std::uint8_t> colors;
  colors.reserve(image.samples8.size() / 4 * 3);
  for (std::size_t at = 0; at < image.samples8.size(); at += 4) {
    const auto first = image.samples8.begin() + static_cast<std::ptrdiff_t>(at);
    colors.insert(colors.end(), first, first + 3);
  }
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  const std::string partial = path + ".part";
  std::error_code error;
  if (png_image_write_to_file(&png, partial.c_str(), 0, colors.data(), 0, nullptr) == 0) {
    std::filesystem::remove(partial, error);
    throw Error(source, std::string("cannot write the picture (") + png.message + ")");
  }
  std::filesystem::rename(partial, path, error);
  if (error) {
    const std::string why = error.message();
    std::filesystem::remove(partial, error);
    throw Error(source, "cannot write the picture (" + why + ")");
  }
}

}  // namespace ardee
