// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/camera_formats.h"

#include <set>

#include "ardee_sim/core/nearest_names.h"

namespace ardee::devices {
namespace {

struct Format {
  render::PixelFormat format;
  const char* encoding;
  std::initializer_list<const char*> names;  // SDF's, Gazebo's, and other common spellings
};

const Format kFormats[] = {
    {render::PixelFormat::kRgb8, "rgb8", {"R8G8B8", "RGB_INT8", "RGB8"}},
    {render::PixelFormat::kBgr8, "bgr8", {"B8G8R8", "BGR_INT8", "BGR8"}},
    {render::PixelFormat::kMono8, "mono8", {"L8", "L_INT8", "MONO8"}},
    {render::PixelFormat::kMono16, "mono16", {"L16", "L_INT16", "L_UINT16", "MONO16"}},
    {render::PixelFormat::kBayerRggb8, "bayer_rggb8", {"BAYER_RGGB8"}},
    {render::PixelFormat::kBayerBggr8, "bayer_bggr8", {"BAYER_BGGR8"}},
    {render::PixelFormat::kBayerGbrg8, "bayer_gbrg8", {"BAYER_GBRG8"}},
    {render::PixelFormat::kBayerGrbg8, "bayer_grbg8", {"BAYER_GRBG8"}},
};

/// Gazebo's and SDF's names of formats that no picture here has.
const std::set<std::string> kOthers{
    "R8G8B8A8",  "A8R8G8B8",   "RGBA_INT8", "BGRA_INT8",  "R16G16B16",   "B16G16R16",
    "RGB_INT16", "RGB_UINT16", "BGR_INT16", "BGR_UINT16", "RGB_INT32",   "RGB_UINT32",
    "BGR_INT32", "BGR_UINT32", "R_FLOAT16", "R_FLOAT32",  "RGB_FLOAT16", "RGB_FLOAT32"};

constexpr char kPlain16[] = "16UC1";  // bytes as in mono16, but not declared as brightness

}  // namespace

render::PixelFormat read_pixel_format(const std::string& name, const Source& source, Log& log) {
  std::vector<std::string> known;
  for (const Format& each : kFormats) {
    for (const char* text : each.names) {
      if (name == text || name == each.encoding) return each.format;
    }
    known.emplace_back(*each.names.begin());
  }
  if (kOthers.count(name) != 0) {
    log.warn(source.to_string() + ": found format '" + name + "', expected one of: " +
             nearest_names(name, known) + "; " + known.front() + " is used");
    return render::PixelFormat::kRgb8;
  }
  throw Error(source,
              "found format '" + name + "', expected one of: " + nearest_names(name, known));
}

render::PixelFormat read_encoding(const std::string& name, const Source& source) {
  std::vector<std::string> known;
  for (const Format& each : kFormats) {
    if (name == each.encoding) return each.format;
    known.emplace_back(each.encoding);
  }
  if (name == kPlain16) return render::PixelFormat::kMono16;
  known.emplace_back(kPlain16);
  throw Error(source,
              "found encoding '" + name + "', expected one of: " + nearest_names(name, known));
}

const char* encoding_of(render::PixelFormat format) {
  for (const Format& each : kFormats) {
    if (each.format == format) return each.encoding;
  }
  return "";
}

}  // namespace ardee::devices
