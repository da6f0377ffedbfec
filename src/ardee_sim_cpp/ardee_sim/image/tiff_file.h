// SPDX-License-Identifier: MIT
#pragma once

#include <tiffio.h>

#include <cstdarg>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/core/error.h"

namespace ardee {

/// A TIFF file, read by libtiff. Each call throws Error at `source` if the file does not allow it.
class TiffFile {
 public:
  TiffFile(const std::string& path, const Source& source);

  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::uint16_t bits() const { return bits_; }
  std::uint16_t orientation() const { return orientation_; }
  std::uint16_t photometric() const { return photometric_; }
  bool holds_floats() const { return format_ == SAMPLEFORMAT_IEEEFP; }
  bool holds_signed() const { return format_ == SAMPLEFORMAT_INT; }
  bool has_geo_keys() const;

  /// The value of "no data"; NaN, which no elevation equals, if the file names none.
  double no_data_value() const;

  /// Calls take(column, row, value) for the first channel of each pixel: floats of 32 or 64 bits or
  /// whole numbers of 8, 16 or 32.
  void read_samples(const std::function<void(std::uint32_t, std::uint32_t, double)>& take);

  /// Red, green, blue and opacity of 8 bits, from the upper left.
  std::vector<std::uint8_t> read_colors();

 private:
  static int keep_error(TIFF*, void* self, const char*, const char* format, va_list arguments);
  static int pass_over(TIFF*, void*, const char*, const char*, va_list) { return 1; }
  Error unreadable() const;
  void check_samples() const;
  bool has_plain_opacity() const;  // colours are not multiplied by it
  double value(const std::uint8_t* bytes) const;

  std::string path_;
  Source source_;
  std::string problem_;
  std::unique_ptr<TIFF, void (*)(TIFF*)> tiff_{nullptr, &TIFFClose};
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint16_t bits_ = 0;
  std::uint16_t format_ = 0;
  std::uint16_t channels_ = 0;
  std::uint16_t planes_ = 0;
  std::uint16_t orientation_ = 0;
  std::uint16_t photometric_ = 0;
};

}  // namespace ardee
