// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// The <material>s of a <robot> by name. The first definition counts, in the robot or in an earlier
/// <visual>.
class UrdfMaterials {
 public:
  UrdfMaterials(const Node& robot, Assets& assets);

  /// Material of a <visual>; none, with a warning, if the material that it names is not defined.
  std::optional<Material> read(const Node& visual);

 private:
  Assets& assets_;
  std::map<std::string, Material> by_name_;
};

/// The <origin> of an element; an absent one is the identity.
Pose read_urdf_origin(const Node& element);

/// A URDF <link> without its pose. A <visual> or <collision> without a shape is left out with a
/// warning.
Link read_urdf_link(const Node& link, UrdfMaterials& materials, Assets& assets);

}  // namespace ardee
