// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ardee_sim/render/image_formation.h"
#include "ardee_sim/simulation/simulation.h"
#include "inbox.h"
#include "world.h"

namespace ardee::python {

namespace py = pybind11;

/// Thrown when a model's state is not valid any more.
class PhysicsFault : public Error {
  using Error::Error;
};

/// What Python wants to spawn.
struct Spawn {
  std::string name;
  std::shared_ptr<const LoadedModel> model;
  Pose X_WM;
  std::string robot_namespace;
  std::map<std::string, double> joint_positions;
  bool is_static = false;
  double scale = 1.0;
  std::uint32_t label = 0;
};

/// A simulation as Python holds it: one caller at a time, readings kept until they are fetched, and
/// no Python in a step.
class BoundSimulation {
 public:
  BoundSimulation(std::shared_ptr<LoadedWorld> world, std::uint64_t seed, int ray_threads);

  /// The right to use the simulation for the time of a call. Throws std::runtime_error if it is
  /// closed, or another thread is using it.
  class Use {
   public:
    explicit Use(BoundSimulation& bound);
    ~Use() { bound_.in_use_ = false; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    Simulation* operator->() const { return bound_.simulation_.get(); }
    Simulation& operator*() const { return *bound_.simulation_; }

   private:
    BoundSimulation& bound_;
  };

  void close();
  void spawn(const Spawn& wanted);
  void remove(const std::string& name);
  /// Steps without the GIL; a signal such as Ctrl-C ends it between two steps.
  void step(std::uint64_t count);
  void reset();
  void set_noise_seed(std::uint64_t seed);
  void set_daylight(double azimuth_deg, double elevation_deg, double turbidity, double cloud);
  py::bytes snapshot();
  void restore(const std::string& bytes);

  RelativeState state(const std::string& name, const std::string& reference);
  void set_state(const std::string& model, const RelativeState& state,
                 const std::string& reference);
  void command(const std::string& topic, const py::object& value);
  py::object call(const std::string& service, const py::args& arguments);

  /// Merges parameters into those there are, by the names that they have on ROS's parameter server.
  void set_parameters(const py::dict& parameters);
  /// Loads the controllers that are not loaded, and starts all; or throws Error and changes
  /// nothing.
  void start_controllers(const std::string& model, const std::vector<std::string>& names);
  void stop_controllers(const std::string& model, const std::vector<std::string>& names);
  /// Returns the states of a model's loaded controllers, by name: initialized, running or stopped.
  py::dict controllers(const std::string& model);

  void demand(const std::string& topic, std::size_t keep);
  void undemand(const std::string& topic);
  bool demands(const std::string& topic);
  py::object latest(const std::string& topic);
  py::list drain(const std::string& topic);
  std::size_t dropped(const std::string& topic);
  void want_contacts() { wants_contacts_ = true; }
  py::list contacts();
  /// Returns the pairs of names of collisions that touched in any step since the last call.
  py::list take_touches();
  /// Returns a dict with the requested parts of rgb, depth_m, labels, instances.
  py::dict picture(const render::Camera& camera, const render::FrameParts& parts,
                   const render::ImageFormation& development);
  std::vector<std::size_t> lone_pixels(const render::Camera& camera,
                                       const std::vector<std::int32_t>& instances);

  /// Returns the description of a model.
  py::object description(const std::string& name);
  /// Returns a tuple for each description of static scenery: the description, and its placements,
  /// float64[n, 8] of x, y, z, qx, qy, qz, qw, scale. Those of a model that has several, such as a
  /// field, are at most `radius_m` from a place on the ground plan.
  py::list scenery(double x_m, double y_m, double radius_m);
  py::list entities();
  /// Returns a tuple for each port: topic or service, class name or command name, "reading",
  /// "command" or "service", rate in Hz or None, frame.
  py::list topics();
  std::vector<LogLine> take_log();
  std::int64_t time_ns();
  std::uint64_t step_count();
  std::int64_t step_ns();
  Eigen::Vector3d gravity_m_s2();

 private:
  void apply_demands();
  template <typename Kind, typename Act>
  std::vector<std::string> for_each(const Simulation& simulation, Act act) const;
  devices::Output& output(const Simulation& simulation, const std::string& topic) const;
  std::shared_ptr<const Model> model_of(const std::string& name, const std::string& text,
                                        const std::string& file);
  void serialize(StateArchive& archive, SimulationState& state);
  void save_entity(StateArchive& archive, SimulationState::EntityState& entity);

  std::shared_ptr<LoadedWorld> world_;
  std::uint64_t seed_;
  std::vector<LogLine> log_;
  Setting parameters_{"", Setting::Map()};  // as on ROS's parameter server
  std::optional<std::string> fault_;
  Inbox inbox_;
  std::map<std::string, std::shared_ptr<const LoadedModel>> spawned_;   // by name
  std::map<std::string, std::shared_ptr<const LoadedModel>> restored_;  // what a restore spawns
  std::atomic<bool> wants_contacts_{false};
  std::set<std::pair<std::string, std::string>> touches_;
  std::atomic<bool> in_use_{false};
  std::unique_ptr<Simulation> simulation_;
};

}  // namespace ardee::python
