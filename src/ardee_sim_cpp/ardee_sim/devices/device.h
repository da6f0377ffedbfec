// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/core/log.h"
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

/// The ray scenes, made when first asked for and brought up to the present state of the world when
/// used.
class RaySceneProvider {
 public:
  using Eye = std::function<Eigen::Vector3d()>;

  virtual ~RaySceneProvider() = default;
  /// Announces a point that rays will start from, as long as the returned token lives: ground near
  /// it is kept ready.
  virtual std::shared_ptr<void> register_eye(raycast::SceneKind kind, Eye eye) = 0;
  /// The scene as of this step.
  virtual const raycast::RayScene& now(raycast::SceneKind kind) = 0;
  /// The visual scene, from now on ready for pictures too.
  virtual const raycast::RayScene& for_pictures() = 0;
};

/// Receives what devices measure; the ROS node publishes it, a test records it.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;
  virtual void on_reading(const Output& output, const Reading& reading) = 0;
};

/// What a device may know of the world that its robot is in.
struct WorldInfo {
  std::function<Eigen::Vector3d()> gravity_m_per_s2;  // as it is now
  std::optional<SphericalCoordinates> spherical_coordinates;
  /// Files that the static models come from, each once.
  std::function<std::vector<std::string>()> scenery_files;
  /// How often static models have come or gone so far.
  std::function<std::uint64_t()> scenery_changes;
  /// Asks, before a step, for its contacts.
  std::function<void()> want_contacts;
  /// Contacts of the last step, if they were asked for.
  std::function<const std::vector<physics::Contact>&()> contacts;
};

inline Setting no_parameter(const std::string& name) { return {name, {}}; }

/// What a device is given when it is made. All references outlive the device.
struct DeviceContext {
  Robot& robot;
  RaySceneProvider& scenes;
  CameraRenderer& pictures;
  const ResourceLocator& locator;  // of the files that plugins name
  Log& log;
  std::uint64_t seed = 0;            // of this robot's streams
  std::string robot_namespace = "";  // where plugins without one of their own put their topics
  TimeNs step_ns = 0;
  /// Prefix of the frames of a namespace (ROS's tf_prefix); empty: none.
  std::function<std::string(const std::string& robot_namespace)> tf_prefix = nullptr;
  WorldInfo world_info = {};
  std::string scope = "";  // of the plugin (PluginDescription)
  /// A parameter by its full name ("/robot/base"); nothing is there without ROS's parameter server.
  std::function<Setting(const std::string& name)> parameter = no_parameter;

  /// Of the link or joint that the plugin names. Throws Error at `source` if there is none.
  std::size_t link_index(const std::string& name, const Source& source) const {
    return robot.link_index(name, source, scope);
  }
  std::size_t joint_index(const std::string& name, const Source& source) const {
    return robot.joint_index(name, source, scope);
  }
};

/// Something active on a robot: a controller, a sensor, a publisher of state.
class Device {
 public:
  explicit Device(std::string name) : name_(std::move(name)) {}
  virtual ~Device() = default;
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const std::string& name() const { return name_; }
  /// Whether the robot does without it where it cannot be, as it does without a sensor.
  bool is_optional() const { return is_optional_; }
  void set_optional(bool is_optional) { is_optional_ = is_optional; }
  Ports& ports() { return ports_; }
  const Ports& ports() const { return ports_; }

  /// Before physics: controllers act.
  virtual void before_step(TimeNs /*now_ns*/) {}
  /// Before physics, after all controllers: what measures over the step notes where it begins.
  virtual void observe(TimeNs /*now_ns*/) {}
  /// Between two steps the model was put elsewhere or given another velocity, by no force.
  virtual void on_set_state() {}
  /// After physics, at the new time: sensors measure.
  virtual void after_step(TimeNs /*now_ns*/, ReadingSink& /*sink*/) {}
  /// State goes back to what it was when the device was made, with the numbers of the description;
  /// commands are forgotten. A random stream begins anew at time zero, and at no other time repeats
  /// what it has given.
  virtual void reset(TimeNs now_ns) = 0;

 protected:
  Output& add_output(const std::string& topic, std::size_t kind) {
    return ports_.add_output(topic, kind);
  }
  void add_service(const std::string& name, Service::Act act) {
    ports_.services.push_back({name, std::move(act)});
  }
  void add_tuning(ParameterGroup tuning) { ports_.tunings.push_back(std::move(tuning)); }

 private:
  std::string name_;
  bool is_optional_ = false;
  Ports ports_;
};

}  // namespace ardee::devices
