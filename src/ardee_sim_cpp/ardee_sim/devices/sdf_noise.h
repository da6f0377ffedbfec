// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/element.h"

namespace ardee::devices {

/// Contents of SDF's <noise> that all sensors share, in the unit of their values.
struct SdfNoise {
  bool is_none = false;  // all other fields are then 0
  double mean = 0.0;
  double std = 0.0;
  double precision = 0.0;  // values are multiples of it; 0: not quantised
};

/// Reads type, mean, stddev and, if values may be quantised, precision; a type that is not
/// gaussian, gaussian_quantized or none is an Error.
SdfNoise read_sdf_noise(const Element& noise, bool may_be_quantised);

}  // namespace ardee::devices
