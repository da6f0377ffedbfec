// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ardee_sim/core/log.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/devices/pictures.h"
#include "ardee_sim/devices/reading.h"
#include "ardee_sim/devices/robot.h"
#include "ardee_sim/physics/contact.h"
#include "ardee_sim/raycast/ray_scene.h"

namespace ardee {

/// Something a device gives: one topic with one kind of reading. `kind` is the index in the Reading
/// variant.
struct Output {
  std::string topic;
  std::size_t kind = 0;
  bool demanded = true;  // false: nobody listens, the device need not measure
  bool latched = false;  // whoever comes later still gets the last reading
};

/// Something a device takes: velocity commands on a topic. One that is not finite is an Error and
/// changes nothing.
struct Input {
  std::string topic;
  std::function<void(const Twist&)> on_command;
};

/// A number that a device takes on a topic: one within [low, high]; others are an Error and change
/// nothing.
struct NumberInput {
  std::string topic;
  double low = 0.0;
  double high = 0.0;
  std::function<void(double)> on_number;
};

/// A wrench in the world's axes that a device takes on a topic. One beyond what the physics takes
/// is an Error and changes nothing.
struct WrenchInput {
  std::string topic;
  std::function<void(const ForceTorque&)> on_wrench;
};

/// A request to act now, without content, on a topic.
struct Trigger {
  std::string topic;
  std::function<void()> on_trigger;
};

/// Where a satellite receiver's local frame lies: WGS-84, orientation in east-north-up.
struct GeoPose {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Something a device does when asked: nothing to say, a vector (a bias), or a geographic pose.
/// What it throws is the caller's answer.
struct Service {
  using Act = std::variant<std::function<void()>, std::function<void(const Eigen::Vector3d&)>,
                           std::function<void(const GeoPose&)>>;
  std::string name;
  Act act;
};

/// A number of a device that may be changed while it runs.
struct Tunable {
  enum class Type { kDouble, kInt, kBool };
  std::string name;
  std::string description;
  Type type = Type::kDouble;
  double low = 0.0;
  double high = 0.0;
  double initial = 0.0;
  std::function<double()> get;
  std::function<void(double)> set;  // called with a number within the bounds
};

/// A group of tunables under one name, as dynamic_reconfigure has them.
struct Tuning {
  std::string name;
  std::vector<Tunable> parameters;
};

/// The ray scenes, made when first asked for and brought up to the present state of the world when
/// used.
class RayScenes {
 public:
  using Eye = std::function<Eigen::Vector3d()>;

  virtual ~RayScenes() = default;
  /// Announces a point that rays will start from, as long as the returned token lives: ground near
  /// it is kept ready.
  virtual std::shared_ptr<void> register_eye(SceneKind kind, Eye eye) = 0;
  /// The scene as of this step.
  virtual const RayScene& now(SceneKind kind) = 0;
  /// The visual scene, from now on ready for pictures too.
  virtual const RayScene& for_pictures() = 0;
};

/// Receives what devices measure; the ROS node publishes it, a test records it.
class ReadingSink {
 public:
  virtual ~ReadingSink() = default;
  virtual void on_reading(const Output& output, const Reading& reading) = 0;
};

/// What a device may know of the world that its robot is in.
struct Surroundings {
  std::function<Eigen::Vector3d()> gravity_m_per_s2;  // as it is now
  std::optional<SphericalCoordinates> spherical_coordinates;
  /// Files that the static models come from, each once.
  std::function<std::vector<std::string>()> scenery_files;
  /// How often static models have come or gone so far.
  std::function<std::uint64_t()> scenery_changes;
  /// Asks, before a step, for its contacts.
  std::function<void()> want_contacts;
  /// Contacts of the last step, if they were asked for.
  std::function<const std::vector<Contact>&()> contacts;
};

/// What a device is given when it is made. All references outlive the device.
struct DeviceContext {
  Robot& robot;
  RayScenes& scenes;
  Pictures& pictures;
  Log& log;
  std::uint64_t seed = 0;       // of this robot's streams
  std::string robot_namespace;  // where plugins without one of their own put their topics
  TimeNs step_ns = 0;
  /// Prefix of the frames of a namespace (ROS's tf_prefix); empty: none.
  std::function<std::string(const std::string& robot_namespace)> tf_prefix;
  Surroundings surroundings;
  std::string scope = "";  // of the plugin (PluginDescription)

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
  bool is_dispensable() const { return is_dispensable_; }
  void set_dispensable(bool is_dispensable) { is_dispensable_ = is_dispensable; }
  std::deque<Output>& outputs() { return outputs_; }
  std::deque<Input>& inputs() { return inputs_; }
  const std::vector<NumberInput>& number_inputs() const { return number_inputs_; }
  const std::vector<WrenchInput>& wrench_inputs() const { return wrench_inputs_; }
  const std::vector<Trigger>& triggers() const { return triggers_; }
  const std::vector<Service>& services() const { return services_; }
  const std::vector<Tuning>& tunings() const { return tunings_; }

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
  /// Addresses of outputs stay valid as more are added.
  Output& add_output(const std::string& topic, std::size_t kind);
  void add_input(const std::string& topic, std::function<void(const Twist&)> on_command);
  void add_number_input(NumberInput input);
  void add_wrench_input(const std::string& topic,
                        std::function<void(const ForceTorque&)> on_wrench);
  void add_trigger(const std::string& topic, std::function<void()> on_trigger);
  void add_service(const std::string& name, Service::Act act);
  void add_tuning(Tuning tuning);

 private:
  std::string name_;
  bool is_dispensable_ = false;
  std::deque<Output> outputs_;
  std::deque<Input> inputs_;
  std::vector<NumberInput> number_inputs_;
  std::vector<WrenchInput> wrench_inputs_;
  std::vector<Trigger> triggers_;
  std::vector<Service> services_;
  std::vector<Tuning> tunings_;
};

/// Position of type T in the Reading variant.
template <typename T, std::size_t kIndex = 0>
constexpr std::size_t reading_kind() {
  if constexpr (std::is_same_v<std::variant_alternative_t<kIndex, Reading>, T>) {
    return kIndex;
  } else {
    return reading_kind<T, kIndex + 1>();
  }
}

}  // namespace ardee
