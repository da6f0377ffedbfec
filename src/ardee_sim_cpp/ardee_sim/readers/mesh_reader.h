// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/description/geometry.h"

namespace ardee {

/// Reads a DAE, STL, OBJ, PLY or glTF file; polygons are cut into triangles. The up-axis tag of a
/// DAE is not applied, nor is the y axis of a glTF turned up, but units and node transforms are, as
/// Gazebo and rviz do. Textures are file paths as written in the mesh, resolved beside it or in
/// ../materials/textures where they exist. One warning names the parts that are left out. Throws
/// Error at `source` if the file is broken, empty or holds values that are not finite.
MeshFile read_mesh_file(const std::string& path, const Source& source, Log& log);

/// The names of a mesh file's parts, each once.
std::vector<std::string> part_names(const MeshFile& file);

}  // namespace ardee
