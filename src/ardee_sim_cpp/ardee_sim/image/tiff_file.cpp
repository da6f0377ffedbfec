// SPDX-License-Identifier: MIT
#include "ardee_sim/image/tiff_file.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace ardee {
namespace {

constexpr std::uint32_t kGeoKeyDirectory = 34735;
constexpr std::uint32_t kGdalNoData = 42113;
constexpr tmsize_t kMostBytes = tmsize_t{1} << 29;

}  // namespace

TiffFile::TiffFile(const std::string& path, const Source& source) : path_(path), source_(source) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             &TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), &TiffFile::keep_error, this);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), &TiffFile::pass_over, this);
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), kMostBytes);
  tiff_.reset(TIFFOpenExt(path.c_str(), "r", options.get()));
  if (tiff_ == nullptr) throw unreadable();
  TIFFGetField(tiff_.get(), TIFFTAG_IMAGEWIDTH, &width_);
  TIFFGetField(tiff_.get(), TIFFTAG_IMAGELENGTH, &height_);
  TIFFGetField(tiff_.get(), TIFFTAG_PHOTOMETRIC, &photometric_);
  TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_BITSPERSAMPLE, &bits_);
  TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_SAMPLEFORMAT, &format_);
  TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_SAMPLESPERPIXEL, &channels_);
  TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_PLANARCONFIG, &planes_);
  TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_ORIENTATION, &orientation_);
}

bool TiffFile::has_geo_keys() const {
  std::uint32_t count = 0;
  void* keys = nullptr;
  return TIFFGetField(tiff_.get(), kGeoKeyDirectory, &count, &keys) != 0;
}

double TiffFile::no_data_value() const {
  std::uint32_t count = 0;
  const char* text = nullptr;
  if (TIFFGetField(tiff_.get(), kGdalNoData, &count, &text) == 0 || count == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::strtod(std::string(text, count).c_str(), nullptr);
}

bool TiffFile::has_plain_opacity() const {
  std::uint16_t count = 0;
  const std::uint16_t* kinds = nullptr;
  TIFFGetFieldDefaulted(tiff_.get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
  return count == 1 && kinds[0] == EXTRASAMPLE_UNASSALPHA;
}

std::vector<std::uint8_t> TiffFile::read_colors() {
  const bool is_plain = has_plain_opacity();
  if (is_plain) {  // libtiff would multiply colours by it, and lose those under holes
    std::uint16_t multiplied = EXTRASAMPLE_ASSOCALPHA;
    TIFFSetField(tiff_.get(), TIFFTAG_EXTRASAMPLES, 1, &multiplied);
  }
  std::vector<std::uint32_t> packed(std::size_t{width_} * height_);
  constexpr int kStopAtErrors = 1;
  if (TIFFReadRGBAImageOriented(tiff_.get(), width_, height_, packed.data(), ORIENTATION_TOPLEFT,
                                kStopAtErrors) == 0) {
    throw unreadable();
  }
  std::vector<std::uint8_t> colors;
  colors.reserve(packed.size() * 4);
  for (const std::uint32_t pixel : packed) {
    const std::uint32_t opacity = TIFFGetA(pixel);
    const auto plain = [&](std::uint32_t color) {
      const bool stays = is_plain || opacity == 0;
      return static_cast<std::uint8_t>(
          stays ? color : std::min(255u, (color * 255u + opacity / 2) / opacity));
    };
    colors.insert(colors.end(), {plain(TIFFGetR(pixel)), plain(TIFFGetG(pixel)),
                                 plain(TIFFGetB(pixel)), static_cast<std::uint8_t>(opacity)});
  }
  return colors;
}

void TiffFile::read_samples(const std::function<void(std::uint32_t, std::uint32_t, double)>& take) {
  check_samples();
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

int TiffFile::keep_error(TIFF*, void* self, const char*, const char* format, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof(text), format, arguments);
  auto* file = static_cast<TiffFile*>(self);
  if (file->problem_.empty()) file->problem_ = text;
  return 1;
}
Error TiffFile::unreadable() const {
  return Error(source_, "found '" + path_ + "', expected a readable TIFF image" +
                            (problem_.empty() ? std::string() : " (" + problem_ + ")"));
}

void TiffFile::check_samples() const {
  const bool is_float = format_ == SAMPLEFORMAT_IEEEFP && (bits_ == 32 || bits_ == 64);
  const bool is_whole = (format_ == SAMPLEFORMAT_INT || format_ == SAMPLEFORMAT_UINT) &&
                        (bits_ == 8 || bits_ == 16 || bits_ == 32);
  if (is_float || is_whole) return;
  throw Error(source_, "found samples of " + std::to_string(bits_) + " bits in '" + path_ +
                           "', expected floats of 32 or 64 or whole numbers of 8, 16 or 32");
}

double TiffFile::value(const std::uint8_t* bytes) const {
  const auto as = [bytes](auto number) {
    std::memcpy(&number, bytes, sizeof(number));
    return static_cast<double>(number);
  };
  if (format_ == SAMPLEFORMAT_IEEEFP) return bits_ == 32 ? as(0.0f) : as(0.0);
  if (format_ == SAMPLEFORMAT_INT) {
    return bits_ == 8 ? as(std::int8_t{}) : bits_ == 16 ? as(std::int16_t{}) : as(std::int32_t{});
  }
  return bits_ == 8 ? as(std::uint8_t{}) : bits_ == 16 ? as(std::uint16_t{}) : as(std::uint32_t{});
}

}  // namespace ardee
