// SPDX-License-Identifier: MIT
#pragma once

#include <assimp/material.h>

#include <string>

#include "ardee_sim/description/material.h"

namespace ardee {

/// Material of a mesh file. Its texture is searched beside the mesh and in ../materials/textures; a
/// missing one is left out.
Material read_mesh_material(const aiMaterial& source, const std::string& mesh_path);

}  // namespace ardee
