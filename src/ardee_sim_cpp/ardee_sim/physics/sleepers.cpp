// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/sleepers.h"

#include <algorithm>
#include <map>

#include "ardee_sim/physics/contact_joints.h"

namespace ardee::physics {
namespace {

constexpr double kReach_m = 0.01;  // m: a nearer model may have leaned on the one that moves away

bool touch(const DynamicModel::Shape& a, const DynamicModel::Shape& b) {
  const Surface& one = a.shape.collision->surface;
  const Surface& other = b.shape.collision->surface;
  if (!meet(one, other) || is_forceless(one, other)) return false;
  if (!geom_bounds(a.shape.geom.get()).intersects(geom_bounds(b.shape.geom.get()))) return false;
  ContactPoints points;
  collide_shapes(a.shape, b.shape, 1, points);
  return !points.empty();
}

bool touch(const DynamicModel& a, const DynamicModel& b) {
  const Eigen::AlignedBox3d bounds = b.bounds();
  for (const DynamicModel::Shape& one : a.shapes()) {
    if (!geom_bounds(one.shape.geom.get()).intersects(bounds)) continue;
    for (const DynamicModel::Shape& other : b.shapes()) {
      if (touch(one, other)) return true;
    }
  }
  return false;
}

}  // namespace

void Sleepers::add(const std::vector<DynamicModel*>& models) {
  if (models.empty()) return;
  for (DynamicModel* model : models) {
    model->fall_asleep(++rests_);
    sleepers_.push_back({model->bounds(), model});
  }
  std::sort(sleepers_.begin(), sleepers_.end(), [](const Sleeper& one, const Sleeper& other) {
    return one.bounds.min().x() < other.bounds.min().x();
  });
  widest_m_ = 0.0;
  for (const Sleeper& each : sleepers_) {
    if (!each.bounds.isEmpty()) widest_m_ = std::max(widest_m_, each.bounds.sizes().x());
  }
}

void Sleepers::remove(const DynamicModel& model) {
  const auto is_it = [&model](const Sleeper& each) { return each.model == &model; };
  sleepers_.erase(std::remove_if(sleepers_.begin(), sleepers_.end(), is_it), sleepers_.end());
}

template <typename Function>
void Sleepers::for_each_in(const Eigen::AlignedBox3d& box, const Function& function) const {
  const auto begins_before = [](const Sleeper& each, double x) {
    return each.bounds.min().x() < x;
  };
  auto each = std::lower_bound(sleepers_.begin(), sleepers_.end(), box.min().x() - widest_m_,
                               begins_before);
  for (; each != sleepers_.end() && each->bounds.min().x() <= box.max().x(); ++each) {
    if (each->model->rest() != 0 && each->bounds.intersects(box)) function(*each->model);
  }
}

void Sleepers::forget_awake() {
  const auto is_awake = [](const Sleeper& each) { return each.model->rest() == 0; };
  sleepers_.erase(std::remove_if(sleepers_.begin(), sleepers_.end(), is_awake), sleepers_.end());
}

void Sleepers::wake_beside_woken() {
  std::vector<Eigen::AlignedBox3d> left;
  for (const Sleeper& each : sleepers_) {
    if (each.model->rest() == 0) left.push_back(each.bounds);
  }
  if (left.empty()) return;
  for (const Eigen::AlignedBox3d& box : left) wake_near(box);
  forget_awake();
}

bool Sleepers::wake_touched(std::vector<DynamicModel*> awake) {
  const std::size_t before = awake.size();
  for (std::size_t next = 0; next < awake.size(); ++next) {
    const DynamicModel& toucher = *awake[next];
    for_each_in(toucher.bounds(), [&](DynamicModel& sleeper) {
      if (!touch(toucher, sleeper)) return;
      sleeper.wake();
      awake.push_back(&sleeper);
    });
  }
  if (awake.size() == before) return false;
  forget_awake();
  return true;
}

void Sleepers::wake_near(const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return;
  const Eigen::Vector3d reach = Eigen::Vector3d::Constant(kReach_m);
  for_each_in({box.min() - reach, box.max() + reach}, [](DynamicModel& each) { each.wake(); });
}

void Sleepers::wake_all() {
  for (const Sleeper& each : sleepers_) each.model->wake();
  sleepers_.clear();
}

void Sleepers::serialize(StateArchive& state,
                         const std::vector<std::unique_ptr<DynamicModel>>& models) {
  std::map<const DynamicModel*, std::size_t> places;
  for (const auto& model : models) places.emplace(model.get(), places.size());
  state(rests_, widest_m_);
  state.size_of(sleepers_);
  for (Sleeper& each : sleepers_) {
    std::size_t index = state.is_restoring() ? 0 : places.at(each.model);
    state(each.bounds.min(), each.bounds.max(), index);
    if (index >= models.size()) StateArchive::refuse();
    each.model = models[index].get();
  }
}

}  // namespace ardee::physics
