// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/camera_lens.h"

#include <cmath>
#include <sstream>

namespace ardee::devices {
namespace {

constexpr double kMostDistortion = 1e3;
constexpr double kMost_px = 1e6;
constexpr double kShortest_px = 1e-3;  // focal length
/// Relative tolerance of a focal length against that of the field of view.
constexpr double kSameFocalLength = 1e-2;

std::array<double, 5> read_distortion(const Element& distortion) {
  Parameters parameters(distortion);
  std::array<double, 5> D{};
  std::size_t k = 0;
  for (const char* key : {"k1", "k2", "p1", "p2", "k3"}) {
    D[k++] = parameters.number(key, 0.0, -kMostDistortion, kMostDistortion);
  }
  const std::string center = parameters.text("center", "0.5 0.5");
  std::istringstream stream(center);
  double x = 0.0, y = 0.0;
  if (!(stream >> x >> y) || x != 0.5 || y != 0.5) {
    throw parameters.error("center", "expected 0.5 0.5: camera_info has no other");
  }
  return D;
}

void read_intrinsics(const Element& intrinsics, render::Lens& lens) {
  Parameters parameters(intrinsics);
  lens.fx_px = parameters.number("fx", lens.fx_px, kShortest_px, kMost_px);
  lens.fy_px = parameters.number("fy", lens.fy_px, kShortest_px, kMost_px);
  lens.cx_px = parameters.number("cx", lens.cx_px, -kMost_px, kMost_px);
  lens.cy_px = parameters.number("cy", lens.cy_px, -kMost_px, kMost_px);
  lens.skew_px = parameters.number("s", 0.0, -kMost_px, kMost_px);
}

/// Returns whether there are <intrinsics>.
bool read_lens_block(const Element& block, render::Lens& lens, Log& log) {
  Parameters parameters(block);
  const std::string type = parameters.text("type", "gnomonical");
  if (type != "gnomonical") {
    log.warn(block.source, "found <type> " + type +
                               ", expected gnomonical: the picture and "
                               "camera_info are those of a pinhole");
  }
  const Element* intrinsics = parameters.block("intrinsics");
  if (intrinsics) read_intrinsics(*intrinsics, lens);
  return intrinsics != nullptr;
}

/// Overrides the focal length and principal point of the field of view by the plugin's.
void read_plugin_intrinsics(Parameters& plugin, const SdfLens& of_sdf, render::Lens& lens,
                            Log& log) {
  const double focal_px = plugin.number("focalLength", 0.0, 0.0, kMost_px);
  const double cx_px = plugin.number("Cx", 0.0, -kMost_px, kMost_px);
  const double cy_px = plugin.number("Cy", 0.0, -kMost_px, kMost_px);
  const auto differs = [](double given, double own) { return given != 0.0 && given != own; };
  if (of_sdf.has_intrinsics) {
    if (differs(focal_px, lens.fx_px) || differs(cx_px, lens.cx_px) || differs(cy_px, lens.cy_px)) {
      log.warn(plugin.source().to_string() +
               ": found <focalLength>, <Cx> or <Cy> other than the <intrinsics> of <camera>, which "
               "picture and camera_info follow");
    }
    return;
  }
  if (focal_px > 0.0) {
    if (std::abs(focal_px / lens.fx_px - 1.0) > kSameFocalLength) {
      std::ostringstream text;
      text << plugin.source().to_string() << ": found <focalLength> " << focal_px << ", expected "
           << lens.fx_px << " by <horizontal_fov>: the picture is taken with the former";
      log.warn(text.str());
    }
    lens.fx_px = lens.fy_px = focal_px;
  }
  if (cx_px != 0.0) lens.cx_px = cx_px;
  if (cy_px != 0.0) lens.cy_px = cy_px;
}

/// Sets the distortion of the picture, and returns that of camera_info.
std::array<double, 5> read_bend(Parameters& plugin, const SdfLens& of_sdf, render::Lens& lens,
                                Log& log) {
  std::array<double, 5> of_plugin{};
  std::size_t k = 0;
  for (const char* key :
       {"distortionK1", "distortionK2", "distortionT1", "distortionT2", "distortionK3"}) {
    of_plugin[k++] = plugin.number(key, 0.0, -kMostDistortion, kMostDistortion);
  }
  const bool automatic = plugin.boolean("autoDistortion", false);
  const bool given = of_plugin != std::array<double, 5>{};
  if (of_sdf.distortion) {
    if (given && of_plugin != *of_sdf.distortion) {
      log.warn(plugin.source().to_string() +
               ": found distortion other than that of <camera>, which camera_info tells");
    }
    return lens.D = *of_sdf.distortion;
  }
  if (automatic) return lens.D = of_plugin;
  if (given) {
    log.warn(plugin.source().to_string() +
             ": found distortion without <autoDistortion>: camera_info tells it, the picture is "
             "straight");
  }
  return of_plugin;
}

}  // namespace

void CameraLens::set_horizontal_fov(int width_px, double fov_rad) {
  const double zoom = render::Lens::pinhole(width_px, 1, fov_rad).fx_px / actual.fx_px;
  actual.fx_px *= zoom;
  actual.fy_px *= zoom;
  actual.skew_px *= zoom;
}

SdfLens read_sdf_lens(Parameters& camera, render::Lens& lens, Log& log) {
  SdfLens found;
  if (const Element* block = camera.block("distortion")) {
    found.distortion = read_distortion(*block);
  }
  if (const Element* block = camera.block("lens")) {
    found.has_intrinsics = read_lens_block(*block, lens, log);
  }
  return found;
}

CameraLens read_camera_lens(Parameters& plugin, const render::Lens& lens, const SdfLens& of_sdf,
                            Log& log) {
  CameraLens made;
  made.actual = lens;
  read_plugin_intrinsics(plugin, of_sdf, made.actual, log);
  const double cx_prime_px = plugin.number("CxPrime", 0.0, -kMost_px, kMost_px);
  if (cx_prime_px != 0.0) made.cx_prime_px = cx_prime_px;
  made.reported = read_bend(plugin, of_sdf, made.actual, log);
  made.baseline_m = plugin.number("hackBaseline", 0.0);
  return made;
}

}  // namespace ardee::devices
