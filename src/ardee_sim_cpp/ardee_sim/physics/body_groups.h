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

/// Rigid body made of links that fixed joints hold together. Masses in kg, lengths in m, in the
/// model's frame M with all joints at zero.
struct BodyGroup {
  std::vector<std::size_t> links;
  /// Whether no force moves the body: one of its links is kinematic, or it is fixed to the world.
  bool kinematic = false;
  double mass_kg = 0.0;
  Eigen::Vector3d com_M{0, 0, 0};
  Eigen::Matrix3d inertia_M = Eigen::Matrix3d::Zero();  // about the centre of mass
  /// The part of the mass that gravity pulls on.
  double gravity_mass_kg = 0.0;
  Eigen::Vector3d gravity_com_M{0, 0, 0};
  // Share of the momentum that a step takes away: the mean of the links' shares, weighted by mass.
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

/// Whether a joint joins its links into one body: a fixed joint does, unless it is measured and has
/// mass on both sides.
bool is_lumped(const Model& model, const Joint& joint);

/// Properties of the links as described.
std::vector<LinkProperties> described_links(const Model& model);

/// Throws Error naming the link if a body that must move has no mass or an inertia that is not
/// finite. If the summed inertia is impossible, the body gets the nearest possible one.
BodyGroups group_links(const Model& model, const std::vector<LinkProperties>& links);

/// Policy for an inertia that no body can have.
enum class OnImpossible { kMend, kRefuse };

/// Recomputes the sums of the links' masses and inertias. Throws as group_links does, and with
/// kRefuse also for an impossible inertia.
void sum_masses(const Model& model, const std::vector<LinkProperties>& links, BodyGroup& group,
                OnImpossible what_then);

}  // namespace ardee::physics
