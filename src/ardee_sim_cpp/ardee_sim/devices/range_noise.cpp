// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/range_noise.h"

#include <cmath>

namespace ardee::devices {

double RangeNoise::corrupt(double range_m, double normal) const {
  const double noisy_m = range_m + mean_m + (std_m + growth * range_m) * normal;
  return precision_m > 0.0 ? precision_m * std::round(noisy_m / precision_m) : noisy_m;
}

}  // namespace ardee::devices
