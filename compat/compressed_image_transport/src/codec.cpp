// SPDX-License-Identifier: MIT
#include "codec.h"

#include <sensor_msgs/image_encodings.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>

#include "encoding.h"

namespace compressed_image_transport {
namespace {

namespace enc = sensor_msgs::image_encodings;

constexpr std::uint32_t kMostJpegPixels = 65500;  // a side: libjpeg's JPEG_MAX_DIMENSION
constexpr std::uint64_t kMostPixels = 1u << 27;
/// A JPEG's block of 8 x 8 pixels takes a bit or more: no sound file has more pixels a byte. So a
/// small file cannot ask for much memory.
constexpr std::uint64_t kMostPixelsPerByte = 512;
constexpr std::uint64_t kMostInflation = 1032;  // of zlib (https://zlib.net/zlib_tech.html)
constexpr std::array<std::uint8_t, 3> kJpegBegin{0xFF, 0xD8, 0xFF};
constexpr std::array<std::uint8_t, 4> kPngBegin{0x89, 'P', 'N', 'G'};

constexpr char kKnown[] =
    "mono8, rgb8, bgr8, rgba8, bgra8, an 8-bit Bayer pattern, mono16 or 16UC1";

struct FreeHandle {
  void operator()(void* handle) const { tjDestroy(handle); }
};
struct FreeBuffer {
  void operator()(unsigned char* buffer) const { tjFree(buffer); }
};
using Handle = std::unique_ptr<void, FreeHandle>;

std::optional<Layout> layout_of(const std::string& encoding) {
  if (encoding == enc::MONO8 || encoding == enc::TYPE_8UC1) return Layout{1, 8, false};
  if (enc::isBayer(encoding) && enc::bitDepth(encoding) == 8) return Layout{1, 8, false};
  if (encoding == enc::RGB8) return Layout{3, 8, false};
  if (encoding == enc::BGR8) return Layout{3, 8, true};
  if (encoding == enc::RGBA8) return Layout{4, 8, false};
  if (encoding == enc::BGRA8) return Layout{4, 8, true};
  if (encoding == enc::MONO16 || encoding == enc::TYPE_16UC1) return Layout{1, 16, false};
  return std::nullopt;
}

TJPF pixel_format(const Layout& layout) {
  if (layout.channels == 1) return TJPF_GRAY;
  if (layout.channels == 3) return layout.is_bgr ? TJPF_BGR : TJPF_RGB;
  return layout.is_bgr ? TJPF_BGRA : TJPF_RGBA;
}

std::string size_text(std::uint64_t width, std::uint64_t height) {
  return std::to_string(width) + "x" + std::to_string(height) + " pixels";
}

Pixels pixels_of(const sensor_msgs::Image& image) {
  const std::optional<Layout> layout = layout_of(image.encoding);
  if (!layout) {
    throw CodecError("found an image of encoding '" + image.encoding + "', expected " + kKnown);
  }
  const std::uint64_t row = std::uint64_t{image.width} * layout->pixel_bytes();
  if (image.width == 0 || image.height == 0 || image.step < row ||
      image.data.size() < std::uint64_t{image.step} * image.height) {
    throw CodecError("found " + std::to_string(image.data.size()) + " bytes for an image of " +
                     size_text(image.width, image.height) + " and " + std::to_string(image.step) +
                     " bytes a row, expected rows of " + std::to_string(row) + " bytes or more");
  }
  const bool is_swapped = (image.is_bigendian != 0) != (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__);
  return {image.data.data(), image.width, image.height, image.step, *layout, is_swapped};
}

std::vector<std::uint8_t> encode_jpeg(const Pixels& pixels, int quality) {
  if (std::max(pixels.width, pixels.height) > kMostJpegPixels) {
    throw CodecError("found " + size_text(pixels.width, pixels.height) +
                     " to compress, expected at most " + std::to_string(kMostJpegPixels) +
                     " a side");
  }
  const int width = static_cast<int>(pixels.width);
  const int height = static_cast<int>(pixels.height);
  const TJSAMP sampling = pixels.layout.is_colour() ? TJSAMP_420 : TJSAMP_GRAY;
  unsigned long size = tjBufSize(width, height, sampling);
  unsigned char* begin = tjAlloc(static_cast<int>(size));
  const std::unique_ptr<unsigned char, FreeBuffer> buffer(begin);
  const Handle handle(tjInitCompress());
  if (!buffer || !handle) throw CodecError("no memory to compress an image");
  if (tjCompress2(handle.get(), pixels.data, width, static_cast<int>(pixels.step), height,
                  pixel_format(pixels.layout), &begin, &size, sampling, quality,
                  TJFLAG_NOREALLOC) != 0) {
    throw CodecError(std::string("found an image that is not compressed: ") +
                     tjGetErrorStr2(handle.get()));
  }
  return {begin, begin + size};
}

sensor_msgs::Image image_of(std::uint32_t width, std::uint32_t height, const std::string& encoding,
                            const Layout& layout) {
  sensor_msgs::Image image;
  image.width = width;
  image.height = height;
  image.encoding = encoding;
  image.is_bigendian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
  image.step = static_cast<std::uint32_t>(width * layout.pixel_bytes());
  return image;
}

/// The encoding that a message's format begins with, "bgr8; jpeg compressed bgr8"; drivers that
/// write "jpeg" alone leave it to the file.
std::string named_encoding(const std::string& format) {
  const std::size_t end = format.find(';');
  return end == std::string::npos ? std::string() : format.substr(0, end);
}

/// `named` where it is an encoding of this depth, else one that suits the file.
std::string encoding_for(const std::string& named, const Layout& of_file) {
  const std::optional<Layout> layout = layout_of(named);
  if (layout && layout->bits == of_file.bits) return named;
  if (of_file.bits == 16) return enc::MONO16;
  return of_file.is_colour() ? enc::BGR8 : enc::MONO8;
}

sensor_msgs::Image decode_jpeg(const std::vector<std::uint8_t>& file, const std::string& named) {
  const Handle handle(tjInitDecompress());
  if (!handle) throw CodecError("no memory to read a JPEG image");
  int width = 0, height = 0, sampling = 0, colours = 0;
  if (tjDecompressHeader3(handle.get(), file.data(), file.size(), &width, &height, &sampling,
                          &colours) != 0) {
    throw CodecError(std::string("found JPEG data that cannot be read: ") +
                     tjGetErrorStr2(handle.get()));
  }
  const std::uint64_t count = static_cast<std::uint64_t>(width) * static_cast<unsigned>(height);
  if (count > std::min(kMostPixels, kMostPixelsPerByte * file.size())) {
    throw CodecError("found " + std::to_string(file.size()) + " bytes that claim to be a JPEG of " +
                     size_text(static_cast<unsigned>(width), static_cast<unsigned>(height)) +
                     ", expected fewer pixels");
  }
  const Layout of_file{colours == TJCS_GRAY ? 1 : 3, 8, true};
  const std::string encoding = encoding_for(named, of_file);
  const Layout layout = *layout_of(encoding);
  sensor_msgs::Image image =
      image_of(static_cast<unsigned>(width), static_cast<unsigned>(height), encoding, layout);
  image.data.resize(std::size_t{image.step} * image.height);
  if (tjDecompress2(handle.get(), file.data(), file.size(), image.data.data(), width,
                    static_cast<int>(image.step), height, pixel_format(layout), 0) != 0) {
    throw CodecError(std::string("found JPEG data that are damaged: ") +
                     tjGetErrorStr2(handle.get()));
  }
  return image;
}

sensor_msgs::Image decode_png_image(const std::vector<std::uint8_t>& file,
                                    const std::string& named) {
  const PngHead head = read_png_head(file);
  if (std::uint64_t{head.width} * head.height > kMostPixels ||
      head.raw_bytes > kMostInflation * file.size()) {
    throw CodecError("found " + std::to_string(file.size()) + " bytes that claim to be a PNG of " +
                     size_text(head.width, head.height) + ", expected fewer pixels");
  }
  const std::string encoding = encoding_for(named, head.layout);
  const Layout layout = *layout_of(encoding);
  sensor_msgs::Image image = image_of(head.width, head.height, encoding, layout);
  image.data = decode_png(file, layout);
  return image;
}

template <std::size_t kSize>
bool begins_with(const std::vector<std::uint8_t>& file, const std::array<std::uint8_t, kSize>& b) {
  return file.size() >= kSize && std::equal(b.begin(), b.end(), file.begin());
}

}  // namespace

sensor_msgs::CompressedImage compress(const sensor_msgs::Image& image, const Options& options) {
  if (options.format != "jpeg" && options.format != "png") {
    throw CodecError("found format '" + options.format + "', expected jpeg or png");
  }
  const Pixels pixels = pixels_of(image);
  const bool is_jpeg = options.format == "jpeg" && pixels.layout.bits == 8;
  sensor_msgs::CompressedImage compressed;
  compressed.header = image.header;
  // what the file holds, as readers that use OpenCV's order of colours see it
  compressed.format = image.encoding + (is_jpeg ? "; jpeg compressed " : "; png compressed ") +
                      (pixels.layout.is_colour() ? "bgr8" : "");
  compressed.data =
      is_jpeg ? encode_jpeg(pixels, options.jpeg_quality) : encode_png(pixels, options.png_level);
  return compressed;
}

sensor_msgs::Image decompress(const sensor_msgs::CompressedImage& compressed) {
  const std::string named = named_encoding(compressed.format);
  sensor_msgs::Image image;
  if (begins_with(compressed.data, kJpegBegin)) {
    image = decode_jpeg(compressed.data, named);
  } else if (begins_with(compressed.data, kPngBegin)) {
    image = decode_png_image(compressed.data, named);
  } else {
    throw CodecError("found " + std::to_string(compressed.data.size()) + " bytes of format '" +
                     compressed.format + "' that are neither, expected JPEG or PNG data");
  }
  image.header = compressed.header;
  return image;
}

}  // namespace compressed_image_transport
