// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "ardee_sim/description/scenery.h"
#include "ardee_sim/physics/collision_shape.h"

namespace ardee::physics {

/// All static shapes, in a uniform grid over the ground plan, so that the cost of finding the
/// shapes near a robot does not depend on the size of the scenery. A shape is built when a robot
/// first comes near and dropped when none has been near for a while: a far plant is only a pose and
/// a box.
class SceneryIndex {
 public:
  explicit SceneryIndex(ShapeFactory& factory) : factory_(factory) {}

  /// Throws Error and adds nothing if a shape cannot be built.
  std::uint32_t add(const std::vector<Placement>& placements, const std::string& name = "",
                    const PlacementNames& placement_names = nullptr);
  void remove(std::uint32_t id);
  /// Bounds of all shapes of one addition.
  Eigen::AlignedBox3d bounds(std::uint32_t id) const;

  /// Begins a step; may drop shapes that no query has returned for a while.
  void begin_step();
  /// Shapes whose bounds meet `box`, in the order of the given names, and for equal names in the
  /// order of adding. They stay until the next begin_step.
  void query(const Eigen::AlignedBox3d& box, std::vector<const CollisionShape*>& shapes);

  /// Whether a box covers only a few cells.
  static bool is_small(const Eigen::AlignedBox3d& box);

  /// Number of bounds compared by the queries of this step, and of shapes alive: the cost of a
  /// step.
  std::size_t tested() const { return tested_; }
  std::size_t built() const { return active_.size(); }

 private:
  struct PrototypeShape {
    const Link* link;
    const Collision* collision;
    Pose X_MC;
  };
  /// The collisions of one description, in its own frame.
  struct Prototype {
    std::shared_ptr<const Model> model;
    std::vector<PrototypeShape> shapes;
  };
  struct Instance {
    Pose X_WM;
    double scale;
    std::uint32_t prototype;
  };
  struct Entry {
    Eigen::AlignedBox3f bounds;  // rounded outwards
    std::uint32_t instance;
    std::uint32_t shape;
  };
  struct Set {
    std::string name;
    PlacementNames placement_names;
    std::vector<Prototype> prototypes;
    std::vector<Instance> instances;
    std::vector<Entry> entries;
  };
  /// Set in the upper, entry in the lower 32 bits: ordered as added.
  using Reference = std::uint64_t;
  struct Active {
    CollisionShape shape;
    std::uint64_t last_used;
  };

  static std::uint32_t prototype_of(const std::shared_ptr<const Model>& model, Set& set,
                                    std::map<const Model*, std::uint32_t>& known);
  static void add_instance(const Placement& placement, std::uint32_t prototype, Set& set);
  const Set& set_of(Reference reference) const;
  const Entry& entry(Reference reference) const;
  std::string scoped_name(Reference reference) const;
  bool comes_before(Reference one, Reference other) const;
  void gather(const std::vector<Reference>& references, const Eigen::AlignedBox3f& box);
  const CollisionShape& activate(Reference reference);

  ShapeFactory& factory_;
  std::uint32_t next_id_ = 1;
  std::map<std::uint32_t, Set> sets_;
  std::unordered_map<std::uint64_t, std::vector<Reference>> cells_;
  std::vector<Reference> unbounded_;
  std::unordered_map<Reference, Active> active_;
  std::uint64_t step_ = 0;
  std::size_t tested_ = 0;
  std::vector<Reference> hits_;
};

}  // namespace ardee::physics
