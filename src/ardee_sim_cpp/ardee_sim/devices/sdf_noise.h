// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/element.h"

namespace ardee::devices {

/// What SDF's <noise> says of every sensor's values, in their unit.
struct SdfNoise {
  bool is_none = false;  // all else is then 0
  double mean = 0.0;
  double std = 0.0;
  double precision = 0.0;  // values are multiples of it; 0: not quantised
};

/// Reads type, mean, stddev and, where values may be quantised, precision; a type that is not
/// gaussian, gaussian_quantized or none is an Error.
SdfNoise read_sdf_noise(const Element& noise, bool may_be_quantised);

}  // namespace ardee::devices
