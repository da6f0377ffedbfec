// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>

#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// The <material>s of a <robot> by name. The first definition counts, be it the robot's or that of
/// a <visual> that comes before.
class UrdfMaterials {
 public:
  UrdfMaterials(const Node& robot, Assets& assets);

  /// Of a <visual>; none, with a warning, if nothing defines the material that it names.
  std::optional<Material> read(const Node& visual);

 private:
  Assets& assets_;
  std::map<std::string, Material> by_name_;
};

/// The <origin> of an element; none is the identity.
Pose read_urdf_origin(const Node& element);

/// A URDF <link> but for its place. A <visual> or <collision> without a shape is left out with a
/// warning.
Link read_urdf_link(const Node& link, UrdfMaterials& materials, Assets& assets);

}  // namespace ardee
