// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "ardee_sim/render/frame.h"

namespace ardee::render {

/// Factors on red, green and blue light.
struct WhiteBalance {
  bool automatic = false;  // gains by grey_world() of each picture
  Eigen::Vector3f gains{1, 1, 1};

  bool is_on() const { return automatic || gains != Eigen::Vector3f(1, 1, 1); }
};

/// Returns the gains that give red and blue the mean of green, within limits (Buchsbaum, Journal of
/// the Franklin Institute 310, 1980).
Eigen::Vector3f grey_world(const Frame& frame);

/// Returns the gains that show a white surface in daylight of this colour temperature (4000 to
/// 25000 K) as grey, that of green being 1; 6504 K is the white of sRGB (CIE 15:2004).
Eigen::Vector3f daylight_gains(double temperature_k);

/// Reads `off`, `auto`, a colour temperature in K, or three gains from 0.01 to 100. Returns none
/// for another text.
std::optional<WhiteBalance> parse_white_balance(const std::string& text);
constexpr char kWhiteBalanceForms[] =
    "expected off, auto, a colour temperature of 4000 to 25000 K, or three gains of 0.01 to 100";

}  // namespace ardee::render
