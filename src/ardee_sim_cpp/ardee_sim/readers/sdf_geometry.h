// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ardee_sim/description/geometry.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// The shape in the <geometry> of a collision or visual. Returns none for <empty>; none with a
/// warning if the shape is missing or not supported (image, polyline); none with an error for a
/// missing file that may be left out. Throws Error on impossible sizes.
std::optional<Geometry> read_sdf_geometry(const Node& owner, Assets& assets);

/// A mesh by its URI, with the checks that SDF and URDF share: a scale without zeros, a submesh
/// that exists.
Mesh make_mesh(const std::string& uri, const std::string& submesh, bool center,
               const Eigen::Vector3d& scale, const Source& source, Assets& assets);

}  // namespace ardee
