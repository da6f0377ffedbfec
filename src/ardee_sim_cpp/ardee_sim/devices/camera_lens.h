// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/render/lens.h"

namespace ardee::devices {

/// A camera's lens: the model that takes the picture, and further values of camera_info.
struct CameraLens {
  render::Lens actual;                  // K, and the distortion of the picture
  std::array<double, 5> reported{};     // D; without <autoDistortion> only reported
  std::optional<double> cx_prime_px{};  // the middle of P in x; none: as in K
  double baseline_m = 0.0;              // P[3] = -fx * baseline

  /// Zooms: changes the focal lengths, keeps the principal point and the distortion.
  void set_horizontal_fov(int width_px, double fov_rad);
};

/// Values given in SDF. They take precedence; a plugin's differing value is a warning.
struct SdfLens {
  std::optional<std::array<double, 5>> distortion;
  bool has_intrinsics = false;
};

/// <distortion>, and <lens> with its <intrinsics>: fx, fy, cx, cy, s in pixels, as camera_info's K
/// has them; absent values follow from the field of view of `lens`. A projection other than the
/// pinhole's is a warning.
SdfLens read_sdf_lens(Parameters& camera, render::Lens& lens, Log& log);

/// The plugin's keys focalLength, Cx, Cy, CxPrime, distortionK1 ..., autoDistortion, hackBaseline.
CameraLens read_camera_lens(Parameters& plugin, const render::Lens& lens, const SdfLens& of_sdf,
                            Log& log);

}  // namespace ardee::devices
