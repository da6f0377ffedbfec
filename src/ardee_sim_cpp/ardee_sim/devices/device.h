// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/description/setting.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/devices/camera_renderer.h"
#include "ardee_sim/devices/ports.h"
#include "ardee_sim/devices/robot.h"
#include "ardee_sim/physics/contact.h"
#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/readers/resource_locator.h"

namespace ardee::devices {

/// The ray scenes, made on first use and brought up to date with the world on each use.
class RaySceneProvider {
 public:
  using Eye = std::function<Eigen::Vector3d()>;

  virtual ~RaySceneProvider() = default;
  /// Announces a point from which rays will start, as long as the returned token lives: ground near
  /// it is kept ready.
  virtual std::shared_ptr<void> register_eye(raycast::SceneKind kind, Eye eye) = 0;
  /// The scene as of this step.
  virtual const raycast::RayScene& now(raycast::SceneKind kind) = 0;
  /// The visual scene, prepared for pictures too from now on.
  virtual const raycast::RayScene& for_pictures() = 0;
};

/// Receives the readings of devices; the ROS node publishes them, a test records them.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;
  virtual void on_reading(const Output& output, const Reading& reading) = 0;
};

/// Facts of the world that a device may ask for.
struct WorldInfo {
  std::function<Eigen::Vector3d()> gravity_m_per_s2;  // present value
  std::optional<SphericalCoordinates> spherical_coordinates;
  /// Returns the files of the static models, each once.
  std::function<std::vector<std::string>()> scenery_files;
  /// Returns the number of additions and removals of static models so far.
  std::function<std::uint64_t()> scenery_changes;
  /// Requests the contacts of the coming step.
  std::function<void()> want_contacts;
  /// Returns the contacts of the last step, if they were requested.
  std::function<const std::vector<physics::Contact>&()> contacts;
};

inline Setting no_parameter(const std::string& name) { return {name, {}}; }

/// Arguments of a device's construction. All references outlive the device.
struct DeviceContext {
  Robot& robot;
  RaySceneProvider& scenes;
  CameraRenderer& pictures;
  const ResourceLocator& locator;  // of the files that plugins name
  Log& log;
  std::uint64_t seed = 0;            // of this robot's streams
  std::string robot_namespace = "";  // of plugins without a namespace of their own
  TimeNs step_ns = 0;
  /// Prefix of the frames of a robot's namespace; empty: none.
  std::function<std::string(const std::string& robot_namespace)> frame_prefix = nullptr;
  WorldInfo world_info = {};
  std::string scope = "";  // of the plugin (PluginDescription)
  /// A parameter by its full name ("/robot/base"); without ROS's parameter server no parameter
  /// exists.
  std::function<Setting(const std::string& name)> parameter = no_parameter;

  /// Index of the link or joint that the plugin names. Throws Error at `source` if there is none.
  std::size_t link_index(const std::string& name, const Source& source) const {
    return robot.link_index(name, source, scope);
  }
  std::size_t joint_index(const std::string& name, const Source& source) const {
    return robot.joint_index(name, source, scope);
  }
};

/// Active part of a robot: a controller, a sensor, a publisher of state.
class Device {
 public:
  explicit Device(std::string name) : name_(std::move(name)) {}
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const std::string& name() const { return name_; }
  /// Whether the robot may be spawned without this device if the device is invalid, as with a
  /// sensor.
  bool is_optional() const { return is_optional_; }
  void set_optional(bool is_optional) { is_optional_ = is_optional; }
  Ports& ports() { return ports_; }

  /// Called before physics: controllers act.
  virtual void before_step(TimeNs /*now_ns*/) {}
  /// Called before physics, after all controllers: a device that measures over the step records its
  /// beginning.
  virtual void observe(TimeNs /*now_ns*/) {}
  /// Called when the model's pose or velocity was set between two steps, without a force.
  virtual void on_set_state() {}
  /// Called after physics, at the new time: sensors measure.
  virtual void after_step(TimeNs /*now_ns*/, ReadingSink& /*sink*/) {}
  /// Restores the state and the numbers of the time when the device was made, and forgets commands.
  /// A random stream begins anew at time zero; at any other time it does not repeat itself.
  virtual void reset(TimeNs now_ns) = 0;
  /// Saves or restores all that steps, commands and tunings change in the device, but not in the
  /// robot's dynamics. A restored device has just been reset.
  virtual void serialize(StateArchive& /*state*/) {}

 protected:
  Output& add_output(const std::string& topic, std::size_t kind, std::optional<double> rate_hz,
                     const std::string& frame_id) {
    return ports_.add_output(topic, kind, rate_hz, frame_id);
  }
  void add_service(const std::string& name, Service::Act act) {
    ports_.add(Service{name, std::move(act)});
  }
  void add_tuning(ParameterGroup tuning) { ports_.add(std::move(tuning)); }

 private:
  std::string name_;
  bool is_optional_ = false;
  Ports ports_;
};

}  // namespace ardee::devices
