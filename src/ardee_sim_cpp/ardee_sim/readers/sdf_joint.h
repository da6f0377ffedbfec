// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <unordered_map>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/sdf_frames.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Context that the joints of a model refer to; it holds all links.
struct JointScope {
  JointScope(int version, const SdfFrames& known_frames, const Model& of);

  int sdf_version;  // 107: SDF 1.7
  const SdfFrames& frames;
  const Model& model;
  std::unordered_map<std::string, Pose> X_ML;  // of its links
};

/// Adds a joint of type gearbox to a model whose other joints have been read: as a coupling of the
/// two joints that hold its links on the reference body. One warning if there are no such joints.
void read_sdf_gearbox(const Node& node, const JointScope& scope, Log& log, Model& model);
/// Reads an SDF <joint> between links, or frames that move with them; a joint whose child is the
/// world becomes one whose parent is the world. A missing axis is z, with a warning if there is no
/// <axis> at all. Throws Error if one of the links does not exist.
Joint read_sdf_joint(const Node& joint, const JointScope& scope, Log& log);

}  // namespace ardee
