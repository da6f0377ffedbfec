// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// An SDF <joint>. Its axes are still in the frame that `axes_in_model_frame` names;
/// finish_sdf_joint turns them.
struct SdfJoint {
  Joint joint;
  bool axis_in_model = false;
  bool axis2_in_model = false;
};

SdfJoint read_sdf_joint(const Node& joint, double sdf_version);

/// Turns axes given in the model's frame into the joint's, and makes a joint whose child is the
/// world one whose parent is. The links that it joins are in `model` already, or an Error.
Joint finish_sdf_joint(const SdfJoint& read, const Model& model);

}  // namespace ardee
