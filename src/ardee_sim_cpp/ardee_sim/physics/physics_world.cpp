// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/physics_world.h"

#include <algorithm>

#include "ardee_sim/core/error.h"
#include "ardee_sim/physics/contact_joints.h"
#include "ardee_sim/physics/dynamic_model.h"
#include "ardee_sim/physics/ode_library.h"
#include "ardee_sim/physics/scenery_index.h"
#include "ardee_sim/physics/solver.h"

namespace ardee {
namespace {

using physics::CollisionShape;
using physics::ContactSide;
using physics::DynamicModel;

Eigen::AlignedBox3d geom_bounds(dGeomID geom) {
  dReal aabb[6];
  dGeomGetAABB(geom, aabb);
  return {Eigen::Vector3d(aabb[0], aabb[2], aabb[4]), Eigen::Vector3d(aabb[1], aabb[3], aabb[5])};
}

void check_params(const PhysicsParams& params) {
  const bool valid = params.step_s >= 1e-6 && params.step_s <= 1.0 &&
                     params.gravity_m_per_s2.norm() < 1e6 && params.iterations > 0 &&
                     params.sor > 0.0 && params.sor < 2.0 && params.cfm >= 0.0 && params.cfm <= 1e6 &&
                     params.erp >= 0.0 && params.erp <= 1.0 && params.max_contacts >= 0;
  if (!valid) {
    throw Error("physics: found a step, iteration count, SOR, CFM, ERP or gravity out of range, "
                "expected 1e-6 <= step <= 1, iterations > 0, 0 < sor < 2, cfm >= 0, 0 <= erp <= 1");
  }
}

}  // namespace

struct PhysicsWorld::Impl {
  /// A model's shapes as they stand before a step.
  struct Moving {
    DynamicModel* model;
    std::vector<Eigen::AlignedBox3d> bounds;
    Eigen::AlignedBox3d all;
  };

  Impl(const PhysicsParams& wanted, Log sink)
      : log(std::move(sink)), world(dWorldCreate()), solver(world.get()), contacts(world.get()), scenery(factory) {
    set_params(wanted);
  }

  void set_params(const PhysicsParams& wanted);
  ContactSide side(const DynamicModel& model, std::size_t shape) const;
  void gather_moving();
  void touch_scenery(const Moving& moving);
  void touch_self(const Moving& moving);
  void touch(const Moving& a, const Moving& b);
  void find_contacts();
  void solve();
  void step();

  physics::OdeLibrary library;
  PhysicsParams params;
  Log log;
  physics::WorldHandle world;
  physics::Solver solver;
  physics::ContactJoints contacts;
  physics::ShapeFactory factory;
  physics::SceneryIndex scenery;
  std::vector<std::unique_ptr<DynamicModel>> models;  // in the order in which they came
  std::vector<Moving> moving;
  std::vector<const CollisionShape*> near;
  std::vector<dBodyID> bodies;
  std::size_t contact_count = 0;
};

void PhysicsWorld::Impl::set_params(const PhysicsParams& wanted) {
  check_params(wanted);
  params = wanted;
  const Eigen::Vector3d& g = params.gravity_m_per_s2;
  dWorldSetGravity(world.get(), g.x(), g.y(), g.z());
  dWorldSetERP(world.get(), params.erp);
  dWorldSetCFM(world.get(), params.cfm);
  dWorldSetQuickStepNumIterations(world.get(), params.iterations);
  dWorldSetQuickStepW(world.get(), params.sor);
  dWorldSetContactSurfaceLayer(world.get(), 0.0);
  dWorldSetContactMaxCorrectingVel(world.get(), dInfinity);
  dWorldSetAutoDisableFlag(world.get(), 0);
}

ContactSide PhysicsWorld::Impl::side(const DynamicModel& model, std::size_t shape) const {
  const DynamicModel::Shape& item = model.shapes()[shape];
  return {&item.shape, model.body(item.group), model.mass_kg() * params.gravity_m_per_s2.norm()};
}

void PhysicsWorld::Impl::gather_moving() {
  moving.resize(models.size());
  for (std::size_t i = 0; i < models.size(); ++i) {
    Moving& item = moving[i];
    item.model = models[i].get();
    item.bounds.clear();
    item.all.setEmpty();
    for (const DynamicModel::Shape& shape : item.model->shapes()) {
      item.bounds.push_back(geom_bounds(shape.shape.geom.get()));
      item.all.extend(item.bounds.back());
    }
  }
}

void PhysicsWorld::Impl::touch_scenery(const Moving& item) {
  if (item.bounds.empty()) return;
  near.clear();
  scenery.query(item.all, near);
  const std::vector<DynamicModel::Shape>& shapes = item.model->shapes();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (item.model->is_kinematic(shapes[i].group)) continue;
    const ContactSide mine = side(*item.model, i);
    for (const CollisionShape* shape : near) {
      if (!shape->bounds.intersects(item.bounds[i])) continue;
      contacts.collide(mine, {shape, nullptr, 0.0}, params);
    }
  }
}

void PhysicsWorld::Impl::touch_self(const Moving& item) {
  for (const auto& [i, j] : item.model->self_pairs()) {
    if (!item.bounds[i].intersects(item.bounds[j])) continue;
    contacts.collide(side(*item.model, i), side(*item.model, j), params);
  }
}

void PhysicsWorld::Impl::touch(const Moving& a, const Moving& b) {
  if (!a.all.intersects(b.all)) return;
  for (std::size_t i = 0; i < a.bounds.size(); ++i) {
    if (!a.bounds[i].intersects(b.all)) continue;
    const bool a_moves = !a.model->is_kinematic(a.model->shapes()[i].group);
    for (std::size_t j = 0; j < b.bounds.size(); ++j) {
      const bool b_moves = !b.model->is_kinematic(b.model->shapes()[j].group);
      if (!(a_moves || b_moves) || !a.bounds[i].intersects(b.bounds[j])) continue;
      if (a_moves) {
        contacts.collide(side(*a.model, i), side(*b.model, j), params);
      } else {
        contacts.collide(side(*b.model, j), side(*a.model, i), params);
      }
    }
  }
}

void PhysicsWorld::Impl::find_contacts() {
  scenery.begin_step();
  gather_moving();
  for (std::size_t i = 0; i < moving.size(); ++i) {
    touch_scenery(moving[i]);
    touch_self(moving[i]);
    for (std::size_t j = i + 1; j < moving.size(); ++j) touch(moving[i], moving[j]);
  }
  contact_count = contacts.count();
}

void PhysicsWorld::Impl::solve() {
  std::size_t rows = 3 * contacts.count();
  bodies.clear();
  for (const auto& model : models) {
    rows += model->rows();
    for (const auto& body : model->bodies()) bodies.push_back(body.get());
  }
  solver.step(params, rows, bodies);
  contacts.clear();
}

void PhysicsWorld::Impl::step() {
  physics::OdeLibrary::prepare_thread();
  for (const auto& model : models) model->check_state();
  for (const auto& model : models) {
    model->prepare_step({params.step_s, params.erp, params.cfm}, params.gravity_m_per_s2);
  }
  find_contacts();
  solve();
  for (const auto& model : models) model->finish_step();
  for (const auto& model : models) model->check_state();
}

PhysicsWorld::PhysicsWorld(const PhysicsParams& params, Log log)
    : impl_(std::make_unique<Impl>(params, std::move(log))) {}

PhysicsWorld::~PhysicsWorld() = default;

const PhysicsParams& PhysicsWorld::params() const { return impl_->params; }

void PhysicsWorld::set_params(const PhysicsParams& params) { impl_->set_params(params); }

PhysicsModel& PhysicsWorld::add_model(std::shared_ptr<const Model> model, const Pose& X_WM) {
  auto added = std::make_unique<DynamicModel>(impl_->world.get(), std::move(model), X_WM,
                                              impl_->factory);
  impl_->models.push_back(std::move(added));
  return *impl_->models.back();
}

void PhysicsWorld::remove_model(PhysicsModel& model) {
  const auto found = std::find_if(impl_->models.begin(), impl_->models.end(),
                                  [&](const auto& item) { return item.get() == &model; });
  if (found == impl_->models.end()) throw Error("physics: found no such model to remove");
  impl_->models.erase(found);
}

PhysicsWorld::SceneryId PhysicsWorld::add_scenery(const std::vector<Placement>& placements) {
  return impl_->scenery.add(placements);
}

void PhysicsWorld::remove_scenery(SceneryId id) { impl_->scenery.remove(id); }

void PhysicsWorld::step() { impl_->step(); }

void PhysicsWorld::reset_random(std::uint64_t seed) {
  dRandSetSeed(static_cast<unsigned long>(seed));
}

PhysicsWorld::Stats PhysicsWorld::stats() const {
  return {impl_->contact_count, impl_->scenery.tested(), impl_->scenery.built()};
}

}  // namespace ardee
