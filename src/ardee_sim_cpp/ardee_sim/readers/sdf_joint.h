// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/sdf_frames.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// An SDF <joint> between links, or frames that move with them; one whose child is the world
/// becomes one whose parent is. The links are in `model` already, or an Error.
Joint read_sdf_joint(const Node& joint, double sdf_version, const SdfFrames& frames,
                     const Model& model);

}  // namespace ardee
