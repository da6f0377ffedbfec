// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/physics_world.h"

#include <algorithm>
#include <sstream>

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/bounds.h"
#include "ardee_sim/physics/contact_finder.h"
#include "ardee_sim/physics/contact_joints.h"
#include "ardee_sim/physics/dynamic_model.h"
#include "ardee_sim/physics/ode_library.h"
#include "ardee_sim/physics/scenery_index.h"
#include "ardee_sim/physics/sleepers.h"
#include "ardee_sim/physics/solver.h"

namespace ardee::physics {
namespace {

using physics::DynamicModel;

void check_params(const PhysicsParams& params) {
  const struct {
    const char* name;
    double value;
    bounds::Range range;
  } numbers[] = {
      {"a step of", params.step_s, bounds::kStep_s},
      {"iterations", static_cast<double>(params.iterations), bounds::kIterations},
      {"SOR", params.sor, bounds::kRelaxation},
      {"CFM", params.cfm, bounds::kCfm},
      {"ERP", params.erp, bounds::kErp},
      {"a greatest correcting velocity of", params.max_correcting_velocity_m_per_s,
       bounds::kCorrectingVelocity},
      {"a contact surface layer of", params.contact_surface_layer_m, bounds::kSurfaceLayer_m}};
  for (const auto& number : numbers) {
    if (number.range.holds(number.value)) continue;
    std::ostringstream what;
    what << "physics: found " << number.name << " " << number.value << ", expected one in ["
         << number.range.low << ", " << number.range.high << "]";
    throw Error(what.str());
  }
  if (!(params.gravity_m_per_s2.norm() < 1e6) || params.max_contacts < 0) {
    throw Error("physics: found gravity of 1e6 m/s^2 or more, or a negative number of contacts");
  }
}

}  // namespace

struct PhysicsWorld::Impl {
  Impl(const PhysicsParams& wanted, Log sink)
      : log(std::move(sink)),
        world(dWorldCreate()),
        solver(world.get()),
        contacts(world.get()),
        scenery(factory),
        finder(scenery, contacts) {
    set_params(wanted);
  }

  void set_params(const PhysicsParams& wanted);
  void step();
  void gather_awake();
  std::vector<LostModel> lost() const;

  physics::OdeLibrary library;
  PhysicsParams params;
  Log log;
  physics::WorldHandle world;
  physics::Solver solver;
  physics::ContactJoints contacts;
  physics::ShapeFactory factory;
  physics::SceneryIndex scenery;
  physics::ContactFinder finder;
  std::vector<std::unique_ptr<DynamicModel>> models;  // in the order of their names
  std::vector<std::string> names;
  std::vector<DynamicModel*> awake;  // of them, in the last step
  physics::Sleepers sleepers;
  std::size_t contact_count = 0;
  bool wants_contacts = false;
  std::vector<Contact> told;  // contacts of the last step
};

void PhysicsWorld::Impl::set_params(const PhysicsParams& wanted) {
  check_params(wanted);
  params = wanted;
  const Eigen::Vector3d& g = params.gravity_m_per_s2;
  dWorldSetGravity(world.get(), g.x(), g.y(), g.z());
  dWorldSetERP(world.get(), params.erp);
  dWorldSetQuickStepNumIterations(world.get(), params.iterations);
  dWorldSetQuickStepW(world.get(), params.sor);
  dWorldSetContactSurfaceLayer(world.get(), 0.0);
  dWorldSetContactMaxCorrectingVel(world.get(), dInfinity);
  dWorldSetAutoDisableFlag(world.get(), 0);
  sleepers.wake_all();
}

std::vector<LostModel> PhysicsWorld::Impl::lost() const {
  std::vector<LostModel> found;
  for (const auto& model : models) {
    if (model->rest() != 0) continue;
    std::string fault = model->state_fault();
    if (!fault.empty()) found.push_back({model.get(), std::move(fault)});
  }
  return found;
}

void PhysicsWorld::Impl::gather_awake() {
  awake.clear();
  for (const auto& model : models) {
    if (model->rest() == 0) awake.push_back(model.get());
  }
}

void PhysicsWorld::Impl::step() {
  physics::OdeLibrary::prepare_thread();
  sleepers.wake_beside_woken();
  gather_awake();
  if (sleepers.wake_touched(awake)) gather_awake();
  for (DynamicModel* model : awake) {
    model->prepare_step({params.step_s, params.erp, std::max(params.cfm, physics::kLeastCfm)},
                        params.gravity_m_per_s2);
  }
  contacts.clear();  // remains of a step that threw
  contacts.set_told(wants_contacts);
  wants_contacts = false;
  finder.find(awake, params);
  contact_count = contacts.count();
  solver.step(params, finder.islands());
  told = contacts.contacts();
  contacts.clear();
  for (DynamicModel* model : awake) model->finish_step(params.step_s);
  sleepers.add(finder.at_rest());
}

PhysicsWorld::PhysicsWorld(const PhysicsParams& params, Log log)
    : impl_(std::make_unique<Impl>(params, std::move(log))) {}

PhysicsWorld::~PhysicsWorld() = default;

const PhysicsParams& PhysicsWorld::params() const { return impl_->params; }

void PhysicsWorld::set_params(const PhysicsParams& params) { impl_->set_params(params); }

PhysicsModel& PhysicsWorld::add_model(std::shared_ptr<const Model> model, const Pose& X_WM,
                                      const std::string& name) {
  auto added = std::make_unique<DynamicModel>(impl_->world.get(), std::move(model), X_WM,
                                              impl_->factory, name);
  std::vector<std::string>& names = impl_->names;
  const auto place = std::upper_bound(names.begin(), names.end(), name);
  const auto model_place = impl_->models.begin() + (place - names.begin());
  names.insert(place, name);
  return **impl_->models.insert(model_place, std::move(added));
}

void PhysicsWorld::remove_model(PhysicsModel& model) {
  const auto found = std::find_if(impl_->models.begin(), impl_->models.end(),
                                  [&](const auto& item) { return item.get() == &model; });
  if (found == impl_->models.end()) throw Error("physics: found no such model to remove");
  impl_->sleepers.wake_beside_woken();
  impl_->sleepers.remove(**found);
  impl_->sleepers.wake_near((*found)->bounds());
  impl_->names.erase(impl_->names.begin() + (found - impl_->models.begin()));
  impl_->models.erase(found);
}

PhysicsWorld::SceneryId PhysicsWorld::add_scenery(const std::vector<Placement>& placements,
                                                  const std::string& name,
                                                  const PlacementNames& placement_names) {
  const SceneryId id = impl_->scenery.add(placements, name, placement_names);
  impl_->sleepers.wake_near(impl_->scenery.bounds(id));
  return id;
}

void PhysicsWorld::remove_scenery(SceneryId id) {
  const Eigen::AlignedBox3d bounds = impl_->scenery.bounds(id);
  impl_->scenery.remove(id);
  impl_->sleepers.wake_near(bounds);
}

std::vector<LostModel> PhysicsWorld::step() {
  impl_->told.clear();
  if (std::vector<LostModel> before = impl_->lost(); !before.empty()) return before;
  try {
    impl_->step();
  } catch (const physics::EngineFault&) {
    if (impl_->lost().empty()) throw;
  }
  return impl_->lost();
}

void PhysicsWorld::want_contacts() { impl_->wants_contacts = true; }

const std::vector<Contact>& PhysicsWorld::contacts() const { return impl_->told; }

void PhysicsWorld::reset_random(std::uint64_t seed) { impl_->solver.reset_random(seed); }

void PhysicsWorld::serialize(StateArchive& state) {
  for (const auto& model : impl_->models) state(*model);
  impl_->sleepers.serialize(state, impl_->models);
  state(impl_->solver, impl_->wants_contacts);
  if (state.is_restoring()) impl_->told.clear();
}

PhysicsWorld::Stats PhysicsWorld::stats() const {
  return {impl_->awake.size(), impl_->contact_count, impl_->scenery.tested(),
          impl_->scenery.built(), impl_->solver.was_direct()};
}

}  // namespace ardee::physics
