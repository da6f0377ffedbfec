// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ardee_sim/description/geometry.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// The shape in the <geometry> of a collision or visual. None for <empty>, with a warning where
/// there is none or one that is not supported (image, polyline), and with an error for a file that
/// may be left out. Throws Error on sizes that no shape has.
std::optional<Geometry> read_sdf_geometry(const Node& owner, Assets& assets);

/// A mesh by its URI, with what SDF and URDF have in common checked: scale without zeros, a submesh
/// that exists.
Mesh make_mesh(const std::string& uri, const std::string& submesh, bool center,
               const Eigen::Vector3d& scale, const Source& source, Assets& assets);

}  // namespace ardee
