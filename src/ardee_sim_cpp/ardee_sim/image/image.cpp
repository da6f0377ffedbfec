// SPDX-License-Identifier: MIT
#include "ardee_sim/image/image.h"

#include <Magick++.h>
#include <png.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>

#include "ardee_sim/core/text_file.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxSide = 16384;
constexpr std::size_t kMaxPixels = std::size_t{1} << 26;
constexpr std::uintmax_t kMaxFileBytes = std::uintmax_t{1} << 29;

void initialize_library() {
  static std::once_flag once;
  std::call_once(once, [] {
    // One thread: the simulation uses the cores. The library starts its threads while it
    // initialises, before a limit set by a call could hold it back.
    setenv("MAGICK_THREAD_LIMIT", "1", 0);
    Magick::InitializeMagick(nullptr);
    Magick::ResourceLimits::width(kMaxSide);
    Magick::ResourceLimits::height(kMaxSide);
  });
}

/// The decoder for a file's first bytes. The library is never left to guess, as some of its formats
/// run programs.
std::string format_of(const std::string& path, const Source& source) {
  std::ifstream stream(path, std::ios::binary);
  std::string head(8, '\0');
  if (!stream.read(head.data(), static_cast<std::streamsize>(head.size()))) {
    throw Error(source, "found a truncated image '" + path + "', expected a whole one");
  }
  if (head == "\x89PNG\r\n\x1a\n") return "png";
  if (head.compare(0, 3, "\xff\xd8\xff") == 0) return "jpeg";
  const std::string four = head.substr(0, 4);
  if (four == std::string("II*\0", 4) || four == std::string("MM\0*", 4)) return "tiff";
  if (head.compare(0, 2, "BM") == 0) return "bmp";
  std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".tga" || extension == ".TGA") return "tga";
  throw Error(source, "found '" + path + "', expected a PNG, JPEG, TIFF, TGA or BMP image");
}

/// The library's message without the leading program name.
std::string reason(const Magick::Exception& problem) {
  const std::string text = problem.what();
  const std::size_t colon = text.find(": ");
  const std::string bare = colon == std::string::npos ? text : text.substr(colon + 2);
  // The library gives no message if an image exceeds the memory of its policy.
  if (bare != "No image was loaded.") return bare;
  return "no more than ImageMagick's policy lets it hold: `identify -list resource` tells";
}

/// Passes errors on, and warnings of a corrupt image (such as truncation), but not a decoder's
/// remarks about unknown tags.
template <typename Action>
void tolerate_remarks(Action action) {
  try {
    action();
  } catch (const Magick::WarningCoder&) {
    // The request was carried out.
  }
}

Magick::Image decode(const std::string& path, const Source& source) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error || bytes > kMaxFileBytes) {
    throw Error(source, "cannot read '" + path + "', expected an image file of at most " +
                            std::to_string(kMaxFileBytes) + " bytes");
  }
  initialize_library();
  const std::string format = format_of(path, source);
  try {
    Magick::Image header;
    tolerate_remarks([&] { header.ping(format + ":" + path); });
    check_image_size(header.columns(), header.rows(), path, source);
    Magick::Image image;
    tolerate_remarks([&] { image.read(format + ":" + path + "[0]"); });
    check_image_size(image.columns(), image.rows(), path, source);
    if (format == "tga" || format == "tiff")
      image.autoOrient();  // they may start at the lower edge
    return image;
  } catch (const Magick::Exception& problem) {
    throw Error(source,
                "found '" + path + "', expected a readable image (" + reason(problem) + ")");
  }
}

template <typename Sample>
std::vector<Sample> pixels(Magick::Image& image, const char* map, Magick::StorageType storage,
                           std::size_t channels, const std::string& path, const Source& source) {
  std::vector<Sample> samples(image.columns() * image.rows() * channels);
  try {
    image.write(0, 0, image.columns(), image.rows(), map, storage, samples.data());
  } catch (const Magick::Exception& problem) {
    throw Error(source, "cannot convert '" + path + "' (" + reason(problem) + ")");
  }
  return samples;
}

Image empty_image(const Magick::Image& decoded, int channels) {
  Image image;
  image.width = static_cast<int>(decoded.columns());
  image.height = static_cast<int>(decoded.rows());
  image.channels = channels;
  image.bits = decoded.depth() > 8 ? 16 : 8;
  return image;
}

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

/// A PNG of one channel of 8 bits, which the library would hold in ten bytes a pixel; none for any
/// other file.
std::optional<Image> read_gray_png(const std::string& path, const Source& source) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMaxFileBytes || format_of(path, source) != "png") return std::nullopt;
  const std::string bytes = without_gamma(read_text_file(path, source, kMaxFileBytes));
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return std::nullopt;
  const std::unique_ptr<png_image, void (*)(png_image*)> closer(&png, &png_image_free);
  if (png.format != PNG_FORMAT_GRAY) return std::nullopt;
  check_image_size(png.width, png.height, path, source);
  Image image;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.channels = 1;
  std::vector<std::uint8_t> samples(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, samples.data(), 0, nullptr) == 0) return std::nullopt;
  constexpr int kWhiteOfBoth = 65535 / 255;
  image.samples16.reserve(samples.size());
  for (const std::uint8_t sample : samples) {
    image.samples16.push_back(static_cast<std::uint16_t>(kWhiteOfBoth * sample));
  }
  return image;
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

Image read_color_image(const std::string& path, const Source& source) {
  Magick::Image decoded = decode(path, source);
  Image image = empty_image(decoded, 4);
  image.samples8 = pixels<std::uint8_t>(decoded, "RGBA", Magick::CharPixel, 4, path, source);
  return image;
}

Image read_gray_image(const std::string& path, const Source& source) {
  if (std::optional<Image> image = read_gray_png(path, source)) return *std::move(image);
  Magick::Image decoded = decode(path, source);
  Image image = empty_image(decoded, 1);
  image.samples16 = pixels<std::uint16_t>(decoded, "R", Magick::ShortPixel, 1, path, source);
  return image;
}

void write_png(const std::string& path, const Image& image) {
  const Source source{path, 0, ""};
  if (image.channels != 4 || image.samples8.empty()) {
    throw Error(source, "found a picture without colours, expected one to write");
  }
  initialize_library();
  const std::string partial = path + ".part";
  std::error_code error;
  try {
    Magick::Image picture(static_cast<std::size_t>(image.width),
                          static_cast<std::size_t>(image.height), "RGBA", Magick::CharPixel,
                          image.samples8.data());
    picture.matte(false);
    picture.depth(8);
    picture.defineValue("png", "exclude-chunks", "date,time,text");
    picture.defineValue("png", "color-type", "2");
    picture.write("png:" + partial);
  } catch (const Magick::Exception& problem) {
    std::filesystem::remove(partial, error);
    throw Error(source, "cannot write the picture (" + reason(problem) + ")");
  }
  std::filesystem::rename(partial, path, error);
  if (error) {
    const std::string why = error.message();
    std::filesystem::remove(partial, error);
    throw Error(source, "cannot write the picture (" + why + ")");
  }
}

}  // namespace ardee
