// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/scenery_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ardee_sim/core/error.h"

namespace ardee::physics {
namespace {

constexpr float kCellSize =
    1.0f;  // m: a robot's bounds overlap a few cells, a cell holds a few plants
constexpr double kMaxCells = 64.0;          // a shape over more cells is tested by every query
constexpr float kMaxCoordinate = 1e6f;      // m: bound of the grid of cells
constexpr std::uint64_t kKeepSteps = 1000;  // steps after which an unused shape may be dropped
constexpr std::uint64_t kSweepSteps = 256;

struct Cells {
  std::int32_t first_x, last_x, first_y, last_y;
};

Cells cells_of(const Eigen::AlignedBox3f& box) {
  const auto cell = [](float x) { return static_cast<std::int32_t>(std::floor(x / kCellSize)); };
  return {cell(box.min().x()), cell(box.max().x()), cell(box.min().y()), cell(box.max().y())};
}

std::uint64_t cell_key(std::int32_t x, std::int32_t y) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32) |
         static_cast<std::uint32_t>(y);
}

/// Number of cells that a box overlaps; infinite if it reaches beyond the grid.
double count_cells(const Eigen::AlignedBox3f& box) {
  const bool counted = box.min().head<2>().minCoeff() > -kMaxCoordinate &&
                       box.max().head<2>().maxCoeff() < kMaxCoordinate;
  if (!counted) return std::numeric_limits<double>::infinity();
  const Cells cells = cells_of(box);
  return (static_cast<double>(cells.last_x) - cells.first_x + 1.0) *
         (static_cast<double>(cells.last_y) - cells.first_y + 1.0);
}

bool fits_cells(const Eigen::AlignedBox3f& box) { return count_cells(box) <= kMaxCells; }

/// The box in floats, never smaller.
Eigen::AlignedBox3f round_outwards(const Eigen::AlignedBox3d& box) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -kFar); };
  const auto up = [](double x) { return std::nextafter(static_cast<float>(x), kFar); };
  return {box.min().unaryExpr(down).cast<float>(), box.max().unaryExpr(up).cast<float>()};
}

template <typename Function>
void for_each_cell(const Eigen::AlignedBox3f& box, const Function& function) {
  const Cells cells = cells_of(box);
  for (std::int32_t x = cells.first_x; x <= cells.last_x; ++x) {
    for (std::int32_t y = cells.first_y; y <= cells.last_y; ++y) function(cell_key(x, y));
  }
}

}  // namespace

std::uint32_t SceneryIndex::prototype_of(const std::shared_ptr<const Model>& model, Set& set,
                                         std::map<const Model*, std::uint32_t>& known) {
  const auto [place, is_new] =
      known.try_emplace(model.get(), static_cast<std::uint32_t>(set.prototypes.size()));
  if (!is_new) return place->second;
  Prototype prototype{model, {}};
  for (const Link& link : model->links) {
    for (const Collision& collision : link.collisions) {
      check_collision(*model, link, collision);
      // Reads the mesh or the heights once, so that errors in them are reported now.
      shape_bounds(collision.geometry, 1.0, Pose{});
      prototype.shapes.push_back({&link, &collision, link.X_ML * collision.X_LC});
    }
  }
  set.prototypes.push_back(std::move(prototype));
  return place->second;
}

void SceneryIndex::add_instance(const Placement& placement, std::uint32_t prototype, Set& set) {
  if (!placement.X_WM.is_finite() || !std::isfinite(placement.scale) || placement.scale <= 0.0) {
    throw Error(placement.model->source,
                "model '" + placement.model->name +
                    "': found a pose or scale that is not finite or a scale "
                    "that is not positive");
  }
  const auto instance = static_cast<std::uint32_t>(set.instances.size());
  set.instances.push_back({placement.X_WM, placement.scale, prototype});
  const std::vector<PrototypeShape>& shapes = set.prototypes[prototype].shapes;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Collision& collision = *shapes[i].collision;
    const Pose X_WC = placement.X_WM * Pose{placement.scale * shapes[i].X_MC.p, shapes[i].X_MC.q};
    const Pose X_WS = shape_pose(collision, X_WC, placement.scale);
    const Eigen::AlignedBox3d bounds = shape_bounds(collision.geometry, placement.scale, X_WS);
    set.entries.push_back({round_outwards(bounds), instance, static_cast<std::uint32_t>(i)});
  }
}

std::uint32_t SceneryIndex::add(const std::vector<Placement>& placements, const std::string& name,
                                const PlacementNames& placement_names) {
  Set set;
  set.name = name;
  set.placement_names = placement_names;
  std::map<const Model*, std::uint32_t> known;
  set.instances.reserve(placements.size());
  set.entries.reserve(placements.size());
  for (const Placement& placement : placements) {
    add_instance(placement, prototype_of(placement.model, set, known), set);
  }
  const std::uint32_t id = next_id_++;
  for (std::size_t i = 0; i < set.entries.size(); ++i) {
    const Reference reference = (static_cast<Reference>(id) << 32) | i;
    const Eigen::AlignedBox3f& bounds = set.entries[i].bounds;
    if (fits_cells(bounds)) {
      for_each_cell(bounds, [&](std::uint64_t key) { cells_[key].push_back(reference); });
    } else {
      unbounded_.push_back(reference);
    }
  }
  sets_.emplace(id, std::move(set));
  return id;
}

void SceneryIndex::remove(std::uint32_t id) {
  const auto found = sets_.find(id);
  if (found == sets_.end())
    throw Error("scenery " + std::to_string(id) + ": found none of that id");
  const auto is_of_set = [id](Reference reference) { return (reference >> 32) == id; };
  const auto erase_from = [&](std::vector<Reference>& references) {
    references.erase(std::remove_if(references.begin(), references.end(), is_of_set),
                     references.end());
  };
  for (const Entry& entry : found->second.entries) {
    if (!fits_cells(entry.bounds)) continue;
    for_each_cell(entry.bounds, [&](std::uint64_t key) {
      const auto cell = cells_.find(key);
      if (cell == cells_.end()) return;
      erase_from(cell->second);
      if (cell->second.empty()) cells_.erase(cell);
    });
  }
  erase_from(unbounded_);
  for (auto it = active_.begin(); it != active_.end();) {
    it = is_of_set(it->first) ? active_.erase(it) : std::next(it);
  }
  sets_.erase(found);
}

Eigen::AlignedBox3d SceneryIndex::bounds(std::uint32_t id) const {
  Eigen::AlignedBox3f all;
  const auto found = sets_.find(id);
  if (found == sets_.end()) return {};
  for (const Entry& entry : found->second.entries) all.extend(entry.bounds);
  return all.isEmpty() ? Eigen::AlignedBox3d() : all.cast<double>();
}

void SceneryIndex::begin_step() {
  ++step_;
  tested_ = 0;
  if (step_ % kSweepSteps != 0) return;
  for (auto it = active_.begin(); it != active_.end();) {
    it = it->second.last_used + kKeepSteps < step_ ? active_.erase(it) : std::next(it);
  }
}

const SceneryIndex::Set& SceneryIndex::set_of(Reference reference) const {
  return sets_.find(static_cast<std::uint32_t>(reference >> 32))->second;
}

const SceneryIndex::Entry& SceneryIndex::entry(Reference reference) const {
  return set_of(reference).entries[static_cast<std::uint32_t>(reference)];
}

std::string SceneryIndex::scoped_name(Reference reference) const {
  const Set& set = set_of(reference);
  const Entry& item = entry(reference);
  const PrototypeShape& shape =
      set.prototypes[set.instances[item.instance].prototype].shapes[item.shape];
  const std::string model = set.placement_names ? set.placement_names(item.instance) : set.name;
  return model + "::" + shape.link->name + "::" + shape.collision->name;
}

bool SceneryIndex::comes_before(Reference one, Reference other) const {
  if (one >> 32 == other >> 32) return one < other;
  const int order = set_of(one).name.compare(set_of(other).name);
  return order != 0 ? order < 0 : one < other;
}

void SceneryIndex::gather(const std::vector<Reference>& references,
                          const Eigen::AlignedBox3f& box) {
  tested_ += references.size();
  for (const Reference reference : references) {
    if (entry(reference).bounds.intersects(box)) hits_.push_back(reference);
  }
}

const CollisionShape& SceneryIndex::activate(Reference reference) {
  const auto found = active_.find(reference);
  if (found != active_.end()) {
    found->second.last_used = step_;
    return found->second.shape;
  }
  const Set& set = set_of(reference);
  const Entry& item = set.entries[static_cast<std::uint32_t>(reference)];
  const Instance& instance = set.instances[item.instance];
  const PrototypeShape& shape = set.prototypes[instance.prototype].shapes[item.shape];
  const Pose X_WC = instance.X_WM * Pose{instance.scale * shape.X_MC.p, shape.X_MC.q};
  Active active{factory_.make(*shape.collision, X_WC, instance.scale), step_};
  active.shape.has_sensor = !shape.link->sensors.empty();
  active.shape.scoped_name = [this, reference, name = std::string()]() mutable {
    if (name.empty()) name = scoped_name(reference);
    return name;
  };
  return active_.emplace(reference, std::move(active)).first->second.shape;
}

bool SceneryIndex::is_small(const Eigen::AlignedBox3d& box) {
  return fits_cells(round_outwards(box));
}

void SceneryIndex::query(const Eigen::AlignedBox3d& box,
                         std::vector<const CollisionShape*>& shapes) {
  const Eigen::AlignedBox3f bounds = round_outwards(box);
  hits_.clear();
  gather(unbounded_, bounds);
  if (count_cells(bounds) <= static_cast<double>(cells_.size())) {
    for_each_cell(bounds, [&](std::uint64_t key) {
      const auto cell = cells_.find(key);
      if (cell != cells_.end()) gather(cell->second, bounds);
    });
  } else {
    // Fewer cells are occupied than lie under the box.
    for (const auto& cell : cells_) gather(cell.second, bounds);
  }
  std::sort(hits_.begin(), hits_.end(),
            [this](Reference one, Reference other) { return comes_before(one, other); });
  hits_.erase(std::unique(hits_.begin(), hits_.end()), hits_.end());
  for (const Reference reference : hits_) shapes.push_back(&activate(reference));
}

}  // namespace ardee::physics
