// SPDX-License-Identifier: MIT
#pragma once

// The readers of a URDF file and its parts, for this folder alone.

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Reads a <robot> with its <gazebo> blocks (http://wiki.ros.org/urdf/XML). All links are kept,
/// massless ones and those on fixed joints too. A root link named "world" stands for the world.
std::shared_ptr<const Model> read_urdf(const Node& robot, Assets& assets);

/// A URDF <joint>: its kind of motion, and the pose of its child.
struct UrdfJoint {
  Joint joint;
  std::optional<Coupling> mimic;
  Pose X_PC;             // at zero, in the parent link's frame
  bool is_free = false;  // floating or planar: nothing holds the child, as in Gazebo
};

UrdfJoint read_urdf_joint(const Node& joint, Log& log);

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

/// Tree of a robot's links.
struct UrdfTree {
  std::vector<std::size_t> order;  // indices of the links, parents before children
  std::vector<Pose> X_ML;          // of each link in the root link's frame, with all joints at zero
};

/// Throws Error unless links and joints make one tree: names that are unique, ends that exist, one
/// root, every other link the child of one joint and reached from the root. Takes time in
/// proportion to their number.
UrdfTree make_urdf_tree(const Node& robot, const std::vector<Link>& links,
                        const std::vector<UrdfJoint>& joints);

/// Reads a <transmission> as ros_control's parser and DefaultRobotHWSim do
/// (http://wiki.ros.org/urdf/XML/Transmission). An incomplete transmission is left out with an
/// error in the log, one of several joints with a warning.
std::optional<Transmission> read_transmission(const Node& transmission, Log& log);

/// Applies the <gazebo> blocks of a <robot> to the model: those with a reference to a link or
/// joint, the others to the model itself. An unknown element is a warning.
void apply_gazebo_blocks(const Node& root, Model& model, Assets& assets);

}  // namespace ardee
