// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/simulation.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "ardee_sim/core/rng.h"

namespace ardee {
namespace {

/// Forwards to nobody while no sink is set.
class NoSink : public ReadingSink {
 public:
  void on_reading(const Output&, const Reading&) override {}
};

constexpr double kFarthest_m = 1e6;  // beyond this a body has left the world

void require_in_world(const std::string& name, const Pose& X_WM) {
  if (X_WM.is_finite() && X_WM.p.norm() <= kFarthest_m) return;
  throw Error("'" + name + "': found a pose that is not finite or farther than " +
              std::to_string(static_cast<int>(kFarthest_m)) + " m from the world's origin");
}

bool is_sane(const Robot& robot) {
  for (std::size_t link = 0; link < robot.model().links.size(); ++link) {
    const Pose pose = robot.link_pose(link);
    const Twist twist = robot.link_twist(link);
    if (!pose.is_finite() || pose.p.norm() > kFarthest_m || !twist.linear.allFinite() ||
        !twist.angular.allFinite()) {
      return false;
    }
  }
  return true;
}

void apply_joint_positions(Entity& entity) {
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

Simulation::Simulation(const World& world, const SimulationOptions& options, LogSink log_sink)
    : world_(world),
      options_(options),
      log_(std::move(log_sink)),
      registry_(builtin_registry()),
      physics_(world.physics, log_),
      scenes_(options.rays, entities_, log_),
      pictures_(world_, options.rays.threads, entities_, scenes_, log_),
      now_ns_(world.start_ns),
      step_ns_(nanoseconds(world.physics.step_s)) {
  const LogGroup group(log_);
  physics_.reset_random(options_.seed);
  world_.models.clear();  // from here on they live in entities_
  for (const PluginDescription& plugin : world.plugins) {
    log_.warn(plugin.element.source.to_string() + ": found world plugin '" + plugin.filename +
              "', expected none: it is left out");
  }
  for (const Instance& instance : world.models) {
    spawn({instance.name,
           instance.model,
           instance.pose,
           "",
           {},
           instance.is_static,
           instance.scale,
           instance.label,
           instance.link_states});
  }
}

Simulation::~Simulation() = default;

Entity& Simulation::spawn(const SpawnRequest& request) {
  const LogGroup group(log_);
  if (request.name.empty()) throw Error("found an empty model name, expected one");
  if (find(request.name)) throw Error("entity already exists: '" + request.name + "'");
  require_in_world(request.name, request.X_WM);
  auto entity = std::make_unique<Entity>();
  // A model without links of its own (a field of included plants) has nothing that could move.
  const bool is_static =
      request.is_static || request.model->is_static || request.model->links.empty();
  entity->instance = {request.model, request.name, request.X_WM,       request.scale,
                      request.label, is_static,    request.link_states};
  entity->robot_namespace = request.robot_namespace;
  entity->joint_positions = request.joint_positions;
  entity->robot = std::make_unique<Robot>(request.name, request.model, next_entity_);
  if (!is_static && !request.model->instances.empty()) {
    throw Error(request.model->source,
                "model '" + request.name + "' moves but holds static models");
  }
  if (is_static) entity->placements = flatten_scenery(entity->instance);
  restore(*entity);
  try {
    if (!is_static) apply_joint_positions(*entity);
    for (const Placement& each : entity->placements) require_in_world(request.name, each.X_WM);
    for (std::size_t link = 0; link < request.model->links.size(); ++link) {
      require_in_world(request.name + "::" + request.model->links[link].name,
                       entity->robot->link_pose(link));
    }
    build_devices(*entity);
    scenes_.add(*entity);
  } catch (...) {
    entity->devices.clear();
    if (is_static)
      physics_.remove_scenery(entity->scenery);
    else
      physics_.remove_model(entity->robot->dynamics());
    throw;
  }
  next_entity_ += std::max<std::uint32_t>(1, static_cast<std::uint32_t>(entity->placements.size()));
  entities_.push_back(std::move(entity));
  pictures_.forget();
  return *entities_.back();
}

void Simulation::restore(Entity& entity) {
  if (entity.is_static()) {
    entity.robot->place(entity.instance.pose);
    entity.scenery = physics_.add_scenery(entity.placements);
  } else {
    entity.robot->attach(&physics_.add_model(entity.instance.model, entity.instance.pose));
  }
}

void Simulation::build_devices(Entity& entity) {
  DeviceContext context{*entity.robot,
                        scenes_,
                        pictures_,
                        log_,
                        stream_key(options_.seed, entity.name()),
                        entity.robot_namespace,
                        step_ns_,
                        options_.tf_prefix,
                        surroundings()};
  entity.devices = registry_.make_devices(context);
  for (const auto& device : entity.devices) device->reset(now_ns_);
}

Surroundings Simulation::surroundings() const {
  Surroundings made;
  made.gravity_m_per_s2 = [this] { return physics_.params().gravity_m_per_s2; };
  made.spherical_coordinates = world_.spherical_coordinates;
  made.scenery_files = [this] {
    std::set<std::string> files;
    for (const auto& entity : entities_) {
      if (entity->is_static()) files.insert(entity->instance.model->source.file);
    }
    return std::vector<std::string>(files.begin(), files.end());
  };
  return made;
}

void Simulation::remove(const std::string& name) {
  const auto found = std::find_if(entities_.begin(), entities_.end(),
                                  [&name](const auto& entity) { return entity->name() == name; });
  if (found == entities_.end()) throw Error("model '" + name + "' does not exist");
  Entity& entity = **found;
  entity.devices.clear();
  wrenches_.clear(*entity.robot);
  scenes_.remove(entity);
  pictures_.forget();
  if (entity.is_static()) {
    physics_.remove_scenery(entity.scenery);
  } else {
    physics_.remove_model(entity.robot->dynamics());
  }
  entities_.erase(found);
}

Entity* Simulation::find(const std::string& name) {
  for (const auto& entity : entities_) {
    if (entity->name() == name) return entity.get();
  }
  return nullptr;
}

void Simulation::step() {
  apply_commands();
  run_controllers();
  step_physics();
  ++step_count_;
  now_ns_ += step_ns_;
  sample_devices();
}

void Simulation::apply_commands() { wrenches_.apply(now_ns_); }

void Simulation::run_controllers() {
  for (const auto& entity : entities_) {
    for (const auto& device : entity->devices) device->before_step(now_ns_);
  }
}

void Simulation::step_physics() {
  try {
    physics_.step();
  } catch (const Error& error) {
    recover(error);
  }
  scenes_.invalidate();
}

void Simulation::recover(const Error& error) {
  bool found = false;
  for (const auto& entity : entities_) {
    if (entity->is_static() || is_sane(*entity->robot)) continue;
    found = true;
    std::ostringstream text;
    text << "at " << seconds(now_ns_) << " s: " << error.what() << "; model '" << entity->name()
         << "' is put back to where it was spawned";
    log_.error(text.str());
    physics_.remove_model(entity->robot->dynamics());
    restore(*entity);
    apply_joint_positions(*entity);
    wrenches_.clear(*entity->robot);
    for (const auto& device : entity->devices) device->reset(now_ns_);
  }
  if (!found) throw error;
}

void Simulation::sample_devices() {
  NoSink nobody;
  ReadingSink& sink = sink_ ? *sink_ : nobody;
  for (const auto& entity : entities_) {
    for (const auto& device : entity->devices) device->after_step(now_ns_, sink);
  }
}

void Simulation::reset_entities() {
  wrenches_.clear_all();
  physics_.reset_random(options_.seed);
  // Moving models are made anew, so that a reset leaves no trace of what was before it.
  for (const auto& entity : entities_) {
    if (!entity->is_static()) physics_.remove_model(entity->robot->dynamics());
  }
  for (const auto& entity : entities_) {
    if (entity->is_static()) {
      place_static(*entity, entity->instance.pose);
    } else {
      restore(*entity);
      apply_joint_positions(*entity);
    }
  }
  for (const auto& entity : entities_) {
    for (const auto& device : entity->devices) device->reset(now_ns_);
  }
  scenes_.invalidate();
}

void Simulation::place_static(Entity& entity, const Pose& X_WM) {
  require_in_world(entity.name(), X_WM);
  const Pose now = entity.robot->pose();
  if (now.p == X_WM.p && now.q.coeffs() == X_WM.q.coeffs()) return;
  Instance moved = entity.instance;
  moved.pose = X_WM;
  scenes_.remove(entity);
  physics_.remove_scenery(entity.scenery);
  entity.placements = flatten_scenery(moved);
  entity.scenery = physics_.add_scenery(entity.placements);
  entity.robot->place(X_WM);
  scenes_.add(entity);
}

void Simulation::reset_world() { reset_entities(); }

void Simulation::reset_simulation() {
  now_ns_ = world_.start_ns;
  step_count_ = 0;
  reset_entities();
}

void Simulation::set_physics(const PhysicsParams& params) {
  if (!(params.step_s >= 1e-6 && params.step_s <= 1.0)) {
    throw Error("found a physics step of " + std::to_string(params.step_s) +
                " s, expected 1e-6 to 1");
  }
  physics_.set_params(params);
  step_ns_ = nanoseconds(params.step_s);
}

}  // namespace ardee
