// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/render/lens.h"

namespace ardee::devices {

/// A camera's lens: what the picture is taken with, and what camera_info says besides.
struct CameraLens {
  render::Lens actual;                  // K, and what bends the picture
  std::array<double, 5> reported{};     // D: of a plugin without <autoDistortion> told only
  std::optional<double> cx_prime_px{};  // the middle of P in x; none: that of K
  double baseline_m = 0.0;              // P[3] = -fx * baseline

  /// Zooms: focal lengths follow, the middle and the distortion stay.
  void set_horizontal_fov(int width_px, double fov_rad);
};

/// What SDF says of a lens stands; a plugin that says something else is warned.
struct SdfLens {
  std::optional<std::array<double, 5>> distortion;
  bool has_intrinsics = false;
};

/// <distortion>, and <lens> with its <intrinsics>: fx, fy, cx, cy, s in pixels, as camera_info's K
/// has them; what is absent follows from the field of view that `lens` has. Other projections than
/// the pinhole's are a warning.
SdfLens read_sdf_lens(Parameters& camera, render::Lens& lens, Log& log);

/// The plugin's keys focalLength, Cx, Cy, CxPrime, distortionK1 ..., autoDistortion, hackBaseline.
CameraLens read_camera_lens(Parameters& plugin, const render::Lens& lens, const SdfLens& of_sdf,
                            Log& log);

}  // namespace ardee::devices
