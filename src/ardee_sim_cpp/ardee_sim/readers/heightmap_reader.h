// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/geometry.h"

namespace ardee {

/// Heights from a grey image that spans size_m.x by size_m.y, its upper edge at +y. Black lies at 0
/// and white at size_m.z, or the other way round if size_m.z is negative. Throws Error at `source`.
HeightGrid read_height_grid(const std::string& path, const Eigen::Vector3d& size_m,
                            const Source& source);

}  // namespace ardee
