// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/bad_parts.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/devices/registry.h"
#include "ardee_sim/simulation/entity.h"
#include "ardee_sim/simulation/handles.h"
#include "ardee_sim/simulation/ray_scene_set.h"
#include "ardee_sim/simulation/simulation_state.h"
#include "ardee_sim/simulation/timed_commands.h"
#include "ardee_sim/simulation/world_camera_renderer.h"

namespace ardee {

struct SimulationOptions {
  std::uint64_t seed = 0;
  raycast::RayOptions rays;
  BadParts bad_parts = BadParts::kRefuse;  // models of the world that cannot be built
  ResourceLocator locator = ResourceLocator::from_environment();  // finds files that plugins name
  std::function<std::string(const std::string& robot_namespace)> frame_prefix;
  std::function<Setting(const std::string& name)> parameter =
      devices::no_parameter;                         // of DeviceContext
  std::vector<devices::PluginAlias> plugin_aliases;  // added to the built-in ones
  /// Known plugins; null: known_plugins(). A larger registry is made by adding to a copy of that.
  std::shared_ptr<const devices::Registry> registry;
};

struct SpawnRequest {
  std::string name;
  std::shared_ptr<const Model> model;
  Pose X_WM;  // frame in which the <pose> of the model's own file is given
  std::string robot_namespace;
  std::map<std::string, double> joint_positions;  // rad or m, by joint name
  bool is_static = false;  // makes the model static even if its description is not
  double scale = 1.0;      // of static models
  std::uint32_t label = 0;
};

/// Pose and velocity of a model or link relative to another, or to the world.
struct RelativeState {
  Pose pose;
  Twist twist;
};

/// Whether a reference names the world: "", "world", "map" or "/map", as in gazebo_ros.
bool names_world(const std::string& name);

/// A link of a model in the world.
struct LinkOf {
  Entity* entity = nullptr;
  std::size_t link = 0;
};

/// A model within a model in the world.
struct NestedModel {
  Entity* entity = nullptr;  // the outermost one
  NamedFrame frame;
};

/// A world with its robots: load, spawn, remove, reset, step. Not thread-safe: one thread owns it,
/// and services act between steps.
class Simulation {
 public:
  /// Shares the world with its other simulations. Throws Error if a part of the world cannot be
  /// built and must not be left out. Without a log sink, warnings and errors go to standard error.
  Simulation(std::shared_ptr<const World> world, const SimulationOptions& options,
             LogSink log_sink);
  /// Takes a world of its own.
  Simulation(World world, const SimulationOptions& options, LogSink log_sink)
      : Simulation(std::make_shared<const World>(std::move(world)), options, std::move(log_sink)) {}
  ~Simulation();

  /// Sets the receiver of all readings from now on; nullptr: none. Without one, only readings that
  /// reading_port() has asked for are measured.
  void set_sink(devices::ReadingSink* sink);

  /// The topic of a robot that takes commands of type T (Twist, double, devices::JointTrajectory,
  /// ...), for command(). If there is no such topic, throws an Error that lists the existing ones.
  template <typename T>
  CommandPort<T> command_port(const std::string& topic) const {
    return {input(topic, devices::command_kind<T>()).topic};
  }
  /// Throws Error if the robot refuses the value, or is gone.
  template <typename T>
  void command(const CommandPort<T>& port, const T& value) {
    input(port.topic, devices::command_kind<T>()).on_command(value);
  }
  /// The topic of a robot that gives readings of type T (devices::LidarReading, ...), for latest();
  /// its device measures from now on. If there is no such topic, throws an Error that lists the
  /// existing ones.
  template <typename T>
  ReadingPort<T> reading_port(const std::string& topic) {
    ReadingPort<T> port;
    port.latest_ = keep_latest(topic, devices::reading_kind<T>());
    return port;
  }
  /// The last reading since the last reset, or null; valid until the next step.
  template <typename T>
  const T* latest(const ReadingPort<T>& port) const {
    return port.latest_ && *port.latest_ ? std::get_if<T>(&**port.latest_) : nullptr;
  }

  /// Adds a model to the running world. Throws Error (name taken, bad plugin value, ...) and then
  /// leaves nothing behind.
  Entity& spawn(const SpawnRequest& request);
  void remove(const std::string& name);
  /// The entity of that name, or nullptr.
  Entity* find(const std::string& name);
  /// The link "model::link" (either name may hold colons itself), else the first link of any model
  /// that has the whole name, as Gazebo finds it.
  std::optional<LinkOf> find_link(const std::string& name) const;
  /// The model "model::nested".
  std::optional<NestedModel> find_nested(const std::string& name) const;
  /// All entities in the order of the world's file, then in the order of spawning.
  const std::vector<std::unique_ptr<Entity>>& entities() const { return entities_; }

  void step();
  TimeNs now_ns() const { return now_ns_; }
  std::uint64_t step_count() const { return step_count_; }

  /// Puts all models back to their spawn poses, at rest, and devices to their initial state with
  /// the numbers of their description; spawned models stay. The clock and the random streams go on.
  void reset_world();
  /// Resets as reset_world does, and restarts the clock, random streams and frame counters: the
  /// readings that follow equal, byte for byte, those that followed the construction.
  void reset_simulation();

  /// The present state, to go on from with restore().
  SimulationState save();
  /// Returns to a saved state, of this simulation or of another one of its world with the same
  /// options: what follows equals, byte for byte, what followed the save (but see
  /// PhysicsWorld::serialize). Models spawned since are removed, removed ones return, goals of
  /// actions end. Throws Error if the state is that of another world, or a controller cannot be
  /// loaded again; then only another restore() or a reset gives a valid state.
  void restore(const SimulationState& state);

  /// Draws the noise of all sensors from other random streams from now on, as another seed of the
  /// simulation would, and resets all devices; models stay where they are, resets keep the seed.
  /// Under 0, the streams are those of the simulation's own seed. What was drawn when a device was
  /// made, such as the fixed bias of an SDF <imu>, stays.
  void set_noise_seed(std::uint64_t seed);

  const World& world() const { return *world_; }
  /// The present lights: those of the world, and all changes by the calls below.
  const std::vector<Light>& lights() const { return lights_; }
  const PhysicsParams& physics() const { return physics_.params(); }
  void set_physics(const PhysicsParams& params);
  /// Adds a light; later pictures show it, and resets keep it. Throws Error if its name is taken or
  /// its pose is outside the world.
  void add_light(const Light& light);
  /// Replaces the light of that name; later pictures show it, and resets keep it. Throws
  /// Error if there is none, as does remove_light.
  void set_light(const Light& light);
  void remove_light(const std::string& name);
  /// Sets the light of sun and sky; later pictures show it, and resets keep it. The sun is the
  /// first directional light, or a new one 'sun'. Throws Error if a number is out of its range.
  void set_daylight(const Daylight& day);

  /// Pose and velocity (axes of the reference) of "model", "model::link" or "model::nested"
  /// relative to another such name, or to the world (names_world). Throws Error for an unknown
  /// name.
  RelativeState state(const std::string& name, const std::string& reference) const;
  /// Moves a model, or the whole model of a link or nested model, which keeps its joints: a part
  /// moved alone would break them. The pose is relative to `reference`; the velocity is the one
  /// that what is named gets in the world, in the axes of `reference`, whose own velocity is not
  /// added (as in gazebo_ros). Throws Error if the state is not valid, and changes nothing then.
  void set_state(const std::string& name, const RelativeState& state, const std::string& reference);
  /// Wrenches on links and efforts on joints for a limited time; a reset of the world or of the
  /// model ends them.
  TimedCommands<Wrench>& wrenches() { return wrenches_; }
  TimedCommands<JointEffort>& joint_efforts() { return joint_efforts_; }
  /// Requests the contacts of the coming step.
  void want_contacts() { physics_.want_contacts(); }
  /// The contacts of the last step, if they were requested.
  const std::vector<physics::Contact>& contacts() const { return physics_.contacts(); }
  /// Takes a picture of the present world by a camera of nobody's.
  render::Frame take_picture(const render::Camera& camera, const render::FrameParts& parts);
  /// The number of pixels that each of these models of the scenery, by ray entity, would cover in
  /// that picture if nothing hid it. Throws Error for another number.
  std::vector<std::size_t> lone_pixels(const render::Camera& camera,
                                       const std::vector<std::uint32_t>& entities) const;
  /// Rays into the present world, for tools (pictures, labels).
  devices::RaySceneProvider& scenes() { return scenes_; }

 private:
  devices::Input& input(const std::string& topic, std::size_t kind) const;
  std::shared_ptr<const LatestReadings::Latest> keep_latest(const std::string& topic,
                                                            std::size_t kind);
  void apply_commands();
  void clear_commands(const devices::Robot& robot);
  void run_controllers();
  void run_observers();
  void step_physics();
  void advance_clock();
  void sample_devices();
  void add_world_models(const std::vector<Instance>& models);
  Entity& add(std::unique_ptr<Entity> entity);
  void build_devices(Entity& entity);
  /// Lets the entity's devices measure what has a receiver.
  void demand_readings(Entity& entity);
  devices::WorldInfo world_info();
  void instantiate(Entity& entity);
  void take_from_physics(const Entity& entity);
  void place_static(Entity& entity, const Pose& X_WM);
  /// Puts a model back to its spawn pose; the rest of the world goes on.
  void put_back(Entity& entity, const std::string& why);
  void reset_entities();
  void serialize_commands(StateArchive& archive);
  /// Removes and adds models so that these are there, in this order.
  void keep_only(const std::vector<SimulationState::EntityState>& wanted);
  /// What a name of a model, link or nested model stands for.
  struct Named {
    Entity* entity;
    RelativeState state_W;
  };
  std::optional<Named> find_named(const std::string& name) const;
  RelativeState state_in_world(const std::string& name) const;

  std::shared_ptr<const World> world_;
  std::vector<Light> lights_;
  std::optional<Daylight> daylight_;
  SimulationOptions options_;
  Log log_;
  devices::Registry registry_;
  physics::PhysicsWorld physics_;
  RaySceneSet scenes_;
  WorldCameraRenderer pictures_;
  TimedCommands<Wrench> wrenches_;
  TimedCommands<JointEffort> joint_efforts_;
  std::vector<std::unique_ptr<Entity>>
      entities_;  // destroyed before the objects that their devices refer to
  std::map<std::string, Entity*> by_name_;  // the order in which they act and measure
  LatestReadings latest_;
  TimeNs now_ns_ = 0;
  TimeNs step_ns_ = 0;
  std::uint64_t step_count_ = 0;
  std::uint32_t next_entity_ = 0;
  std::uint64_t scenery_changes_ = 0;
};

}  // namespace ardee
