// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/properties.h"

namespace ardee::physics {

/// Links that fixed joints hold together: one rigid body. Masses in kg, lengths in m, in the
/// model's frame M with all joints at zero.
struct BodyGroup {
  std::vector<std::size_t> links;
  /// Moved by no force: a kinematic link is among them, or they are fixed to the world.
  bool kinematic = false;
  double mass_kg = 0.0;
  Eigen::Vector3d com_M{0, 0, 0};
  Eigen::Matrix3d inertia_M = Eigen::Matrix3d::Zero();  // about the centre of mass
  /// The part of the mass that gravity pulls on.
  double gravity_mass_kg = 0.0;
  Eigen::Vector3d gravity_com_M{0, 0, 0};
  // Share of the momentum that a step takes away: each link's part loses its own.
  double linear_decay = 0.0;
  double angular_decay = 0.0;
};

struct BodyGroups {
  std::vector<BodyGroup> groups;
  std::vector<std::size_t> of_link;  // group of each link
  std::size_t world = kNone;         // the group that stands for the world, if a joint names it

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
};

/// The links of a model by name.
using LinkIndex = std::unordered_map<std::string, std::size_t>;
LinkIndex index_links(const Model& model);

/// Whether a joint makes one body of its links: a fixed one does, unless it is measured and has
/// mass on both sides.
bool is_lumped(const Model& model, const Joint& joint);

/// Properties of the links as described.
std::vector<LinkProperties> described_links(const Model& model);

/// Throws Error naming the link if a body that must move has no mass or an inertia that is not
/// finite. The inertia of a body is the nearest possible one if the sum of its links' is none.
BodyGroups group_links(const Model& model, const std::vector<LinkProperties>& links);

/// What becomes of an inertia that no body has.
enum class OnImpossible { kMend, kRefuse };

/// Sums the links' masses and inertias anew; throws as group_links, and for an inertia that no body
/// has if it is to be as given.
void sum_masses(const Model& model, const std::vector<LinkProperties>& links, BodyGroup& group,
                OnImpossible what_then);

}  // namespace ardee::physics
