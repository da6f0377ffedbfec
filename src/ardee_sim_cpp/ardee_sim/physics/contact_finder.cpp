// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/contact_finder.h"

#include <algorithm>
#include <numeric>

namespace ardee::physics {
namespace {

constexpr std::size_t kRowsPerContact = 3;

ContactSide side(const DynamicModel& model, std::size_t shape, const PhysicsParams& params) {
  const DynamicModel::Shape& item = model.shapes()[shape];
  return {&item.shape, model.body(item.group), model.mass_kg() * params.gravity_m_per_s2.norm()};
}

bool moves(const DynamicModel& model, std::size_t shape) {
  return !model.is_kinematic(model.shapes()[shape].group);
}

}  // namespace

void ContactFinder::gather(const std::vector<DynamicModel*>& models) {
  moving_.resize(models.size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    Moving& item = moving_[i];
    item.model = models[i];
    item.bounds.clear();
    item.all.setEmpty();
    item.rows = item.model->rows();
    item.on_scenery = false;
    item.is_felt = false;
    item.island = i;
    for (const DynamicModel::Shape& shape : item.model->shapes()) {
      item.bounds.push_back(geom_bounds(shape.shape.geom.get()));
      item.all.extend(item.bounds.back());
    }
  }
}

void ContactFinder::touch_scenery(Moving& item, const PhysicsParams& params) {
  if (item.bounds.empty()) return;
  // Links may be far apart: scenery between them is not tested.
  const bool at_once = SceneryIndex::is_small(item.all);
  near_.clear();
  if (at_once) scenery_.query(item.all, near_);
  const std::size_t before = contacts_.count();
  for (std::size_t i = 0; i < item.bounds.size(); ++i) {
    if (!moves(*item.model, i)) continue;
    if (!at_once) {
      near_.clear();
      scenery_.query(item.bounds[i], near_);
    }
    const ContactSide mine = side(*item.model, i, params);
    for (const CollisionShape* shape : near_) {
      if (!shape->bounds.intersects(item.bounds[i])) continue;
      contacts_.collide(mine, {shape, nullptr, 0.0}, params);
      item.is_felt = item.is_felt || shape->has_sensor;
    }
  }
  item.rows += kRowsPerContact * (contacts_.count() - before);
  item.on_scenery = contacts_.count() > before;
}

void ContactFinder::touch_self(Moving& item, const PhysicsParams& params) {
  const std::size_t before = contacts_.count();
  for (const auto& [i, j] : item.model->self_pairs()) {
    if (!item.bounds[i].intersects(item.bounds[j])) continue;
    contacts_.collide(side(*item.model, i, params), side(*item.model, j, params), params);
  }
  item.rows += kRowsPerContact * (contacts_.count() - before);
}

void ContactFinder::touch(std::size_t first, std::size_t second, const PhysicsParams& params) {
  Moving& a = moving_[first];
  const Moving& b = moving_[second];
  const std::size_t before = contacts_.count();
  for (std::size_t i = 0; i < a.bounds.size(); ++i) {
    if (!a.bounds[i].intersects(b.all)) continue;
    for (std::size_t j = 0; j < b.bounds.size(); ++j) {
      if (!a.bounds[i].intersects(b.bounds[j])) continue;
      // The first side of a contact is a moving model.
      if (moves(*a.model, i)) {
        contacts_.collide(side(*a.model, i, params), side(*b.model, j, params), params);
      } else if (moves(*b.model, j)) {
        contacts_.collide(side(*b.model, j, params), side(*a.model, i, params), params);
      }
    }
  }
  if (contacts_.count() == before) return;
  a.rows += kRowsPerContact * (contacts_.count() - before);
  moving_[island_of(second)].island = island_of(first);
}

void ContactFinder::pair_up() {
  by_x_.resize(moving_.size());
  std::iota(by_x_.begin(), by_x_.end(), std::size_t{0});
  std::sort(by_x_.begin(), by_x_.end(), [this](std::size_t one, std::size_t other) {
    return moving_[one].all.min().x() < moving_[other].all.min().x();
  });
  pairs_.clear();
  for (auto one = by_x_.begin(); one != by_x_.end(); ++one) {
    const Eigen::AlignedBox3d& box = moving_[*one].all;
    for (auto other = one + 1; other != by_x_.end(); ++other) {
      if (moving_[*other].all.min().x() > box.max().x()) break;
      if (moving_[*other].all.intersects(box)) pairs_.push_back(std::minmax(*one, *other));
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
}

void ContactFinder::find(const std::vector<DynamicModel*>& models, const PhysicsParams& params) {
  scenery_.begin_step();
  gather(models);
  pair_up();
  auto pair = pairs_.begin();
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    touch_scenery(moving_[i], params);
    touch_self(moving_[i], params);
    for (; pair != pairs_.end() && pair->first == i; ++pair) touch(i, pair->second, params);
  }
}

std::size_t ContactFinder::island_of(std::size_t index) {
  while (moving_[index].island != index) index = moving_[index].island;
  return index;
}

std::vector<Island> ContactFinder::islands() {
  std::vector<Island> found;
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> number(moving_.size(), kNone);  // of the island, at its root
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    std::size_t& at_root = number[island_of(i)];
    if (at_root == kNone) {
      at_root = found.size();
      found.emplace_back();
    }
    Island& island = found[at_root];
    island.rows += moving_[i].rows;
    ++island.models;
    for (auto& [name, coupling] : moving_[i].model->couplings()) {
      island.couplings.push_back(&coupling);
    }
    for (const BodyHandle& body : moving_[i].model->bodies()) island.bodies.push_back(body.get());
  }
  return found;
}

std::vector<DynamicModel*> ContactFinder::at_rest() {
  std::vector<bool> rests(moving_.size(), true), stands(moving_.size(), false);  // at the root
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const std::size_t root = island_of(i);
    if (moving_[i].is_felt || !moving_[i].model->is_at_rest()) rests[root] = false;
    if (moving_[i].on_scenery) stands[root] = true;
  }
  std::vector<DynamicModel*> found;
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const std::size_t root = island_of(i);
    if (rests[root] && stands[root]) found.push_back(moving_[i].model);
  }
  return found;
}

}  // namespace ardee::physics
