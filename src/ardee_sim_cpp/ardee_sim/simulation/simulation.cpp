// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/simulation.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/core/rng.h"
#include "ardee_sim/simulation/lone_pixels.h"
#include "ardee_sim/simulation/plugins.h"

namespace ardee {
namespace {

constexpr TimeNs kPutBackSilence_ns = 1000000000;

void require_in_world(const std::string& name, const Pose& X_WM) {
  if (limits::is_valid(X_WM)) return;
  throw Error("'" + name + "': found a pose that is not finite or farther than " +
              std::to_string(static_cast<int>(limits::kFarthest_m)) + " m from the world's origin");
}

Error taken(const std::string& name) { return Error("entity already exists: '" + name + "'"); }

void apply_initial_state(Entity& entity) {
  if (entity.instance.link_states) {
    entity.robot->dynamics().set_link_states(*entity.instance.link_states);
  }
  for (const auto& [name, position] : entity.joint_positions) {
    const Source& source = entity.instance.model->source;
    const std::size_t joint = entity.robot->joint_index(name, source);
    entity.robot->dynamics().set_joint_position(joint, position);
  }
}

}  // namespace

Simulation::Simulation(std::shared_ptr<const World> world, const SimulationOptions& options,
                       LogSink log_sink)
    : world_(std::move(world)),
      lights_(world_->lights),
      options_(options),
      log_(log_sink ? Log(std::move(log_sink)) : Log()),
      registry_(options.registry != nullptr ? *options.registry : known_plugins()),
      physics_(world_->physics, log_),
      scenes_(options.rays, entities_, log_),
      pictures_(world_->scene, lights_, daylight_, options.rays.threads, entities_, scenes_, log_),
      now_ns_(world_->start_ns),
      step_ns_(nanoseconds(world_->physics.step_s)) {
  const LogGroup group(log_);
  for (const devices::PluginAlias& alias : options.plugin_aliases) registry_.add_alias(alias);
  physics_.reset_random(options_.seed);
  for (const PluginDescription& plugin : world_->plugins) {
    log_.warn(plugin.element.source.to_string() + ": found world plugin '" + plugin.filename +
              "', expected none: it is left out");
  }
  add_world_models(world_->models);
}

Simulation::~Simulation() = default;

void Simulation::add_world_models(const std::vector<Instance>& models) {
  // Entities are numbered by their names, so that neither the numbers nor the surface that a ray
  // hits of two coplanar ones depend on the order of the file.
  std::map<std::string, std::size_t> place;
  for (const Instance& instance : models) {
    if (!place.emplace(instance.name, place.size()).second) throw taken(instance.name);
  }
  for (const auto& [name, index] : place) {
    auto entity = std::make_unique<Entity>();
    entity->instance = models[index];
    try {
      add(std::move(entity));
    } catch (const Error& problem) {
      if (options_.bad_parts == BadParts::kRefuse) throw;
      log_.error(std::string(problem.what()) + "; model '" + name + "' is left out");
    }
  }
  std::sort(entities_.begin(), entities_.end(), [&place](const auto& one, const auto& other) {
    return place.at(one->name()) < place.at(other->name());
  });
}

Entity& Simulation::spawn(const SpawnRequest& request) {
  const LogGroup group(log_);
  const Model& model = *request.model;
  const bool moves = !request.is_static && !model.is_static && !model.links.empty();
  if (moves ? request.scale != 1.0 : !(request.scale > 0.0 && std::isfinite(request.scale))) {
    throw Error(model.source, "model '" + request.name + "': found the scale " +
                                  std::to_string(request.scale) + ", expected " +
                                  (moves ? "1 of a model that moves" : "a positive number"));
  }
  auto entity = std::make_unique<Entity>();
  entity->instance = {request.model, request.name,  request.X_WM * request.model->own_pose,
                      request.scale, request.label, request.is_static};
  entity->robot_namespace = request.robot_namespace;
  entity->joint_positions = request.joint_positions;
  return add(std::move(entity));
}

Entity& Simulation::add(std::unique_ptr<Entity> entity) {
  const std::string& name = entity->name();
  const std::shared_ptr<const Model> model = entity->instance.model;
  if (name.empty()) throw Error("found an empty model name, expected one");
  if (name == "world") {
    throw Error(
        "found the model name 'world', which is that of the inertial frame, expected another");
  }
  if (find(name)) throw taken(name);
  require_in_world(name, entity->instance.pose);
  // A model without links of its own (a field of included plants) has nothing that could move.
  if (model->is_static || model->links.empty()) entity->instance.is_static = true;
  entity->robot = std::make_unique<devices::Robot>(name, model, next_entity_);
  if (!entity->is_static() && !model->instances.empty()) {
    throw Error(model->source, "model '" + name + "' moves but holds static models");
  }
  if (entity->is_static()) entity->placements = flatten_scenery(entity->instance);
  instantiate(*entity);
  try {
    for (const Placement& each : entity->placements) require_in_world(name, each.X_WM);
    for (std::size_t link = 0; link < model->links.size(); ++link) {
      require_in_world(name + "::" + model->links[link].name, entity->robot->link_pose(link));
    }
    build_devices(*entity);
    scenes_.add(*entity);
  } catch (...) {
    entity->devices.clear();
    take_from_physics(*entity);
    throw;
  }
  next_entity_ += std::max<std::uint32_t>(1, static_cast<std::uint32_t>(entity->placements.size()));
  if (entity->is_static()) ++scenery_changes_;
  by_name_.emplace(name, entity.get());
  entities_.push_back(std::move(entity));
  pictures_.forget();
  return *entities_.back();
}

void Simulation::instantiate(Entity& entity) {
  if (entity.is_static()) {
    entity.robot->place(entity.instance.pose);
    entity.scenery =
        physics_.add_scenery(entity.placements, entity.name(), placement_names(entity.instance));
    return;
  }
  physics::PhysicsModel& dynamics =
      physics_.add_model(entity.instance.model, entity.instance.pose, entity.name());
  try {
    entity.robot->attach(&dynamics);
    apply_initial_state(entity);
  } catch (...) {
    physics_.remove_model(dynamics);
    throw;
  }
}

void Simulation::take_from_physics(const Entity& entity) {
  if (entity.is_static()) {
    physics_.remove_scenery(entity.scenery);
  } else {
    physics_.remove_model(entity.robot->dynamics());
  }
}

void Simulation::build_devices(Entity& entity) {
  devices::DeviceContext context{*entity.robot, scenes_, pictures_, options_.locator, log_};
  context.seed = stream_key(options_.seed, entity.name());
  context.robot_namespace = entity.robot_namespace;
  context.step_ns = step_ns_;
  context.frame_prefix = options_.frame_prefix;
  context.world_info = world_info();
  context.parameter = options_.parameter;
  entity.devices = registry_.make_devices(context);
  demand_readings(entity);
  for (const auto& device : entity.devices) device->reset(now_ns_);
}

devices::WorldInfo Simulation::world_info() {
  devices::WorldInfo made;
  made.gravity_m_per_s2 = [this] { return physics_.params().gravity_m_per_s2; };
  made.spherical_coordinates = world_->spherical_coordinates;
  made.scenery_files = [this] {
    std::set<std::string> files;
    for (const auto& entity : entities_) {
      if (entity->is_static()) files.insert(entity->instance.model->source.file);
    }
    return std::vector<std::string>(files.begin(), files.end());
  };
  made.scenery_changes = [this] { return scenery_changes_; };
  made.want_contacts = [this] { physics_.want_contacts(); };
  made.contacts = [this]() -> const std::vector<physics::Contact>& { return physics_.contacts(); };
  return made;
}

void Simulation::remove(const std::string& name) {
  const auto found = std::find_if(entities_.begin(), entities_.end(),
                                  [&name](const auto& entity) { return entity->name() == name; });
  if (found == entities_.end()) throw Error("model '" + name + "' does not exist");
  Entity& entity = **found;
  entity.devices.clear();
  clear_commands(*entity.robot);
  scenes_.remove(entity);
  pictures_.forget();
  take_from_physics(entity);
  if (entity.is_static()) ++scenery_changes_;
  by_name_.erase(name);
  entities_.erase(found);
}

Entity* Simulation::find(const std::string& name) {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : found->second;
}

void Simulation::step() {
  apply_commands();
  run_controllers();
  run_observers();
  step_physics();
  advance_clock();
  sample_devices();
}

void Simulation::apply_commands() {
  wrenches_.apply(now_ns_);
  joint_efforts_.apply(now_ns_);
}

void Simulation::clear_commands(const devices::Robot& robot) {
  wrenches_.clear(robot);
  joint_efforts_.clear(robot);
}

void Simulation::run_controllers() {
  for (const auto& [name, entity] : by_name_) {
    try {
      for (const auto& device : entity->devices) device->before_step(now_ns_);
    } catch (const Error& error) {  // it requests the impossible
      if (entity->is_static()) throw;
      put_back(*entity, error.what());
    }
  }
}

void Simulation::run_observers() {
  for (const auto& [name, entity] : by_name_) {
    for (const auto& device : entity->devices) device->observe(now_ns_);
  }
}

void Simulation::step_physics() {
  for (const physics::LostModel& lost : physics_.step()) {
    const auto is_lost = [&lost](const auto& entity) {
      return !entity->is_static() && &entity->robot->dynamics() == lost.model;
    };
    put_back(**std::find_if(entities_.begin(), entities_.end(), is_lost), lost.why);
  }
  scenes_.invalidate();
}

void Simulation::put_back(Entity& entity, const std::string& why) {
  std::optional<TimeNs>& told_ns = entity.told_put_back_ns;
  if (!told_ns || now_ns_ < *told_ns || now_ns_ - *told_ns >= kPutBackSilence_ns) {
    std::ostringstream text;
    text << "at " << seconds(now_ns_) << " s: " << why << "; model '" << entity.name()
         << "' is put back to where it was spawned (said at most once a second)";
    log_.error(text.str());
    told_ns = now_ns_;
  }
  clear_commands(*entity.robot);
  physics_.remove_model(entity.robot->dynamics());
  instantiate(entity);
  for (const auto& device : entity.devices) device->reset(now_ns_);
}

void Simulation::advance_clock() {
  ++step_count_;
  now_ns_ += step_ns_;
}

void Simulation::sample_devices() {
  for (const auto& [name, entity] : by_name_) {
    for (const auto& device : entity->devices) device->after_step(now_ns_, latest_);
  }
}

void Simulation::reset_entities() {
  wrenches_.clear_all();
  joint_efforts_.clear_all();
  physics_.reset_random(options_.seed);
  // Moving models are rebuilt, so that no earlier state survives a reset.
  for (const auto& entity : entities_) {
    if (!entity->is_static()) physics_.remove_model(entity->robot->dynamics());
  }
  for (const auto& entity : entities_) {
    if (entity->is_static()) {
      place_static(*entity, entity->instance.pose);
    } else {
      instantiate(*entity);
    }
  }
  for (const auto& entity : entities_) {
    for (const auto& device : entity->devices) device->reset(now_ns_);
  }
  scenes_.set_picture_places({});
  scenes_.invalidate();
  latest_.clear();
}

void Simulation::place_static(Entity& entity, const Pose& X_WM) {
  const Pose now = entity.robot->pose();
  if (now.p == X_WM.p && now.q.coeffs() == X_WM.q.coeffs()) return;
  require_in_world(entity.name(), X_WM);
  Instance moved = entity.instance;
  moved.pose = X_WM;
  std::vector<Placement> placements = flatten_scenery(moved);
  for (const Placement& each : placements) require_in_world(entity.name(), each.X_WM);
  scenes_.remove(entity);
  physics_.remove_scenery(entity.scenery);
  entity.placements = std::move(placements);
  entity.scenery =
      physics_.add_scenery(entity.placements, entity.name(), placement_names(entity.instance));
  entity.robot->place(X_WM);
  scenes_.add(entity);
}

render::Frame Simulation::take_picture(const render::Camera& camera,
                                       const render::FrameParts& parts) {
  const auto eye =
      scenes_.register_eye(raycast::SceneKind::kVisual, [&camera] { return camera.X_WC.p; });
  scenes_.invalidate();
  return pictures_.take(camera, parts);
}

std::vector<std::size_t> Simulation::lone_pixels(const render::Camera& camera,
                                                 const std::vector<std::uint32_t>& entities) const {
  std::map<std::uint32_t, const Entity*> by_first;
  for (const auto& entity : entities_) by_first[entity->robot->entity()] = entity.get();
  std::vector<std::size_t> counts;
  for (const std::uint32_t number : entities) {
    const auto after = by_first.upper_bound(number);
    const Entity* owner = after == by_first.begin() ? nullptr : std::prev(after)->second;
    const std::size_t k = owner ? number - owner->robot->entity() : 0;
    if (!owner || k >= owner->placements.size()) {
      throw Error("found instance " + std::to_string(number + 1) + ", expected one of the scenery");
    }
    counts.push_back(ardee::lone_pixels(owner->placements[k], camera, options_.rays, log_));
  }
  return counts;
}

void Simulation::set_noise_seed(std::uint64_t seed) {
  for (const auto& entity : entities_) {
    entity->robot->set_noise_seed(seed);
    for (const auto& device : entity->devices) device->reset(now_ns_);
  }
  latest_.clear();
}

void Simulation::reset_world() { reset_entities(); }

void Simulation::reset_simulation() {
  now_ns_ = world_->start_ns;
  step_count_ = 0;
  reset_entities();
}

void Simulation::set_physics(const PhysicsParams& params) {
  physics_.set_params(params);
  step_ns_ = nanoseconds(params.step_s);
}

}  // namespace ardee
