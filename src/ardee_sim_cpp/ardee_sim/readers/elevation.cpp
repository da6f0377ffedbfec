// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/elevation.h"

#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>

#include "ardee_sim/image/image.h"

namespace ardee {
namespace {

constexpr std::uint32_t kGeoKeyDirectory = 34735;
constexpr std::uint32_t kGdalNoData = 42113;
constexpr tmsize_t kMostBytes = tmsize_t{1} << 29;
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

/// A TIFF file, read by libtiff; only its first channel counts.
class TiffFile {
 public:
  TiffFile(const std::string& path, const Source& source) : path_(path), source_(source) {
    const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(
        TIFFOpenOptionsAlloc(), &TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &TiffFile::keep_error, this);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &TiffFile::pass_over, this);
    TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostBytes);
    tiff_.reset(TIFFOpenExt(path.c_str(), "r", options.get()));
    if (tiff_ == nullptr) throw unreadable();
    TIFFGetField(tiff_.get(), TIFFTAG_IMAGEWIDTH, &width_);
    TIFFGetField(tiff_.get(), TIFFTAG_IMAGELENGTH, &height_);
    TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_BITSPERSAMPLE, &bits_);
    TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_SAMPLEFORMAT, &format_);
    TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_SAMPLESPERPIXEL, &channels_);
    TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_PLANARCONFIG, &planes_);
    TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_ORIENTATION, &orientation_);
  }

  bool holds_elevations() const {
    std::uint32_t count = 0;
    void* keys = nullptr;
    return format_ == SAMPLEFORMAT_IEEEFP || format_ == SAMPLEFORMAT_INT || bits_ == 32 ||
           (bits_ == 16 && TIFFGetField(tiff_.get(), kGeoKeyDirectory, &count, &keys) != 0);
  }

  Elevation read() {
    check_image_size(width_, height_, path_, source_);
    if (orientation_ != ORIENTATION_TOPLEFT) {
      throw Error(source_, "found elevations of orientation " + std::to_string(orientation_) +
                               " in '" + path_ +
                               "', expected 1 (rows from the top, from the left)");
    }
    check_samples();
    Elevation made;
    made.width = static_cast<int>(width_);
    made.height = static_cast<int>(height_);
    made.elevations_m.resize(std::size_t{width_} * height_);
    const double no_data = no_data_value();
    read_samples([&](std::uint32_t column, std::uint32_t row, double value) {
      const bool known = std::abs(value) < kAbsurd_m && value != no_data;
      made.elevations_m[std::size_t{row} * width_ + column] =
          known ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
    });
    return made;
  }

 private:
  static int keep_error(TIFF*, void* self, const char*, const char* format, va_list arguments) {
    char text[256];
    std::vsnprintf(text, sizeof(text), format, arguments);
    auto* file = static_cast<TiffFile*>(self);
    if (file->problem_.empty()) file->problem_ = text;
    return 1;
  }
  static int pass_over(TIFF*, void*, const char*, const char*, va_list) { return 1; }

  Error unreadable() const {
    return Error(source_, "found '" + path_ + "', expected a readable TIFF image" +
                              (problem_.empty() ? std::string() : " (" + problem_ + ")"));
  }

  void check_samples() const {
    const bool is_float = format_ == SAMPLEFORMAT_IEEEFP && (bits_ == 32 || bits_ == 64);
    const bool is_whole = (format_ == SAMPLEFORMAT_INT || format_ == SAMPLEFORMAT_UINT) &&
                          (bits_ == 8 || bits_ == 16 || bits_ == 32);
    if (is_float || is_whole) return;
    throw Error(source_, "found elevations of " + std::to_string(bits_) + " bits in '" + path_ +
                             "', expected floats of 32 or 64 or whole numbers of 8, 16 or 32");
  }

  /// The value of "no data"; NaN, which no elevation equals, if the file names none.
  double no_data_value() const {
    std::uint32_t count = 0;
    const char* text = nullptr;
    if (TIFFGetField(tiff_.get(), kGdalNoData, &count, &text) == 0 || count == 0) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    return std::strtod(std::string(text, count).c_str(), nullptr);
  }

  double value(const std::uint8_t* bytes) const {
    const auto as = [bytes](auto number) {
      std::memcpy(&number, bytes, sizeof(number));
      return static_cast<double>(number);
    };
    if (format_ == SAMPLEFORMAT_IEEEFP) return bits_ == 32 ? as(0.0f) : as(0.0);
    if (format_ == SAMPLEFORMAT_INT) {
      return bits_ == 8 ? as(std::int8_t{}) : bits_ == 16 ? as(std::int16_t{}) : as(std::int32_t{});
    }
    return bits_ == 8    ? as(std::uint8_t{})
           : bits_ == 16 ? as(std::uint16_t{})
                         : as(std::uint32_t{});
  }

  /// Calls take(column, row, value) for the first channel of each pixel.
  template <typename Take>
  void read_samples(Take take) {
    const std::size_t step =
        bits_ / 8u * (planes_ == PLANARCONFIG_CONTIG ? std::size_t{channels_} : 1u);
    const bool tiled = TIFFIsTiled(tiff_.get()) != 0;
    std::uint32_t across = width_;
    std::uint32_t down = 1;
    if (tiled) {
      TIFFGetField(tiff_.get(), TIFFTAG_TILEWIDTH, &across);
      TIFFGetField(tiff_.get(), TIFFTAG_TILELENGTH, &down);
    }
    const tmsize_t bytes = tiled ? TIFFTileSize(tiff_.get()) : TIFFScanlineSize(tiff_.get());
    if (across == 0 || down == 0 || bytes <= 0 || bytes > kMostBytes ||
        std::size_t{across} * down * step > static_cast<std::size_t>(bytes)) {
      throw unreadable();
    }
    std::vector<std::uint8_t> buffer(static_cast<std::size_t>(bytes));
    for (std::uint32_t y = 0; y < height_; y += down) {
      for (std::uint32_t x = 0; x < width_; x += across) {
        const auto got = tiled ? TIFFReadTile(tiff_.get(), buffer.data(), x, y, 0, 0)
                               : TIFFReadScanline(tiff_.get(), buffer.data(), y, 0);
        if (got < 0) throw unreadable();
        for (std::uint32_t row = y; row < std::min(y + down, height_); ++row) {
          for (std::uint32_t column = x; column < std::min(x + across, width_); ++column) {
            const std::size_t pixel = std::size_t{row - y} * across + (column - x);
            take(column, row, value(buffer.data() + pixel * step));
          }
        }
      }
    }
  }

  const std::string& path_;
  const Source& source_;
  std::string problem_;
  std::unique_ptr<TIFF, void (*)(TIFF*)> tiff_{nullptr, &TIFFClose};
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint16_t bits_ = 0;
  std::uint16_t format_ = 0;
  std::uint16_t channels_ = 0;
  std::uint16_t planes_ = 0;
  std::uint16_t orientation_ = 0;
};

}  // namespace

std::optional<Elevation> read_elevation(const std::string& path, const Source& source) {
  if (!is_tiff(path)) return std::nullopt;
  TiffFile file(path, source);
  if (!file.holds_elevations()) return std::nullopt;
  return file.read();
}

}  // namespace ardee
