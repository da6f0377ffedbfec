// SPDX-License-Identifier: MIT
#pragma once

#include <assimp/material.h>

#include <string>

#include "ardee_sim/description/material.h"

namespace ardee {

/// A mesh file's own material. Its texture is looked for beside the mesh and in
/// ../materials/textures; one that is nowhere is left out.
Material read_mesh_material(const aiMaterial& source, const std::string& mesh_path);

}  // namespace ardee
