// SPDX-License-Identifier: MIT
#pragma once

// The readers of the parts of an SDF file, for this folder alone.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/geometry.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/readers/assets.h"
#include "ardee_sim/readers/sdf_frames.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {

/// Parts of a world other than models.
Light read_sdf_light(const Node& light, const Pose& X_WL);
Scene read_sdf_scene(const Node& scene);
SphericalCoordinates read_spherical_coordinates(const Node& coordinates);
/// <physics> (the default one of several) and <gravity> of a <world>.
PhysicsParams read_sdf_physics(const Node& world, Log& log);

/// An SDF <material>: its script's material, or Gazebo's, with the colours given beside it taking
/// precedence.
Material read_sdf_material(const Node& material, Assets& assets);

/// The shape in the <geometry> of a collision or visual. Returns none for <empty>; none with a
/// warning if the shape is missing or not supported (image, polyline); none with an error for a
/// missing file that may be left out. Throws Error on impossible sizes.
std::optional<Geometry> read_sdf_geometry(const Node& owner, Assets& assets);

/// A mesh by its URI, with the checks that SDF and URDF share: a scale without zeros, a submesh
/// that exists.
Mesh make_mesh(const std::string& uri, const std::string& submesh, bool center,
               const Eigen::Vector3d& scale, const Source& source, Assets& assets);

/// An SDF <link> with all its parts; it is one of the model's `frames`. Throws Error with file and
/// line.
Link read_sdf_link(const Node& link, const SdfFrames& frames, Assets& assets);

/// Applies the <surface> and <max_contacts> of a <collision> to `made`.
Surface read_sdf_surface(const Node& collision, Surface made = {});

/// Reads a <mu>: a negative value is infinite, as in Gazebo; an empty one is `otherwise`.
double read_friction(const Node& mu, double otherwise);

SensorDescription read_sensor(const Node& sensor, const Pose& X_LS, Log& log);
PluginDescription read_plugin(const Node& plugin);

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

/// Positions of the models of a <population>, in its frame [m]: within its box or cylinder, centred
/// at the origin, by its <distribution>. The population's name seeds random positions.
std::vector<Eigen::Vector3d> read_population(const Node& population);

/// Sets the clock, models, links and lights of a world to its <state>, which Gazebo writes when it
/// saves a world, and removes the models in <deletions>. Poses of links are in the world's frame.
/// One warning names the entries that the world does not have.
void apply_sdf_state(const Node& state, World& world, Log& log);

}  // namespace ardee
