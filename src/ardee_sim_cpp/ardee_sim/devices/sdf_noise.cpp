// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/sdf_noise.h"

#include "ardee_sim/description/parameters.h"

namespace ardee::devices {

SdfNoise read_sdf_noise(const Element& noise, bool may_be_quantised) {
  Parameters parameters(noise);
  const auto attribute = noise.attributes.find("type");
  const std::string type =
      attribute == noise.attributes.end() ? parameters.text("type", "gaussian") : attribute->second;
  SdfNoise read;
  read.mean = parameters.number("mean", 0.0);
  read.std = parameters.number("stddev", 0.0, 0.0);
  if (may_be_quantised) read.precision = parameters.number("precision", 0.0, 0.0);
  if (type == "none") return {true};
  if (type == "gaussian_quantized" && may_be_quantised) return read;
  if (type != "gaussian") {
    throw Error(noise.source, "found noise type '" + type + "', expected gaussian" +
                                  (may_be_quantised ? ", gaussian_quantized" : "") + " or none");
  }
  read.precision = 0.0;
  return read;
}

}  // namespace ardee::devices
