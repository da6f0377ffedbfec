// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/description/geometry.h"

namespace ardee {

/// Reads heights from an image or an elevation file that spans size_m.x by size_m.y, its upper edge
/// at +y. As in Gazebo, black lies at 0 and the brightest pixel of an 8-bit image at size_m.z, even
/// if that is grey; but an image whose brightest value is 1 is scaled as if it had white. White of
/// a 16-bit image lies at size_m.z. The least elevation of a file lies at 0 and the greatest at
/// size_m.z. A negative size_m.z turns heights upside down. Throws Error at `source`.
HeightGrid read_height_grid(const std::string& path, const Eigen::Vector3d& size_m,
                            const Source& source, Log& log);

}  // namespace ardee
