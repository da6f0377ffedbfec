// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/sdf_frames.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// An SDF <joint> (of a file of version 107: 1.7) between links, or frames that move with them; one
/// whose child is the world becomes one whose parent is. The links are in `model` already, or an
/// Error. An axis that is not written is z, with a warning if there is no <axis> at all.
Joint read_sdf_joint(const Node& joint, int sdf_version, const SdfFrames& frames,
                     const Model& model, Log& log);

}  // namespace ardee
