// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/devices/actions.h"
#include "ardee_sim/devices/command.h"
#include "ardee_sim/devices/reading.h"

namespace ardee::devices {

/// Position of type T in the variant.
template <typename Variant, typename T, std::size_t kIndex = 0>
constexpr std::size_t index_in() {
  if constexpr (std::is_same_v<std::variant_alternative_t<kIndex, Variant>, T>) {
    return kIndex;
  } else {
    return index_in<Variant, T, kIndex + 1>();
  }
}
template <typename T>
constexpr std::size_t reading_kind() {
  return index_in<Reading, T>();
}
template <typename T>
constexpr std::size_t command_kind() {
  return index_in<Command, T>();
}

/// Output of a device: one topic with one kind of reading. `kind` is the index in the Reading
/// variant.
struct Output {
  std::string topic;
  std::size_t kind = 0;
  /// Readings per simulated second, 0: one in each step; none: not periodic, or a ros_control
  /// controller's, whose parameters define it.
  std::optional<double> rate_hz = std::nullopt;
  std::string frame_id = "";  // of the readings' headers; empty also if they differ
  bool demanded = true;       // false: no subscriber, the device need not measure
  bool latched = false;       // a later subscriber still gets the last reading
};

/// Input of a device: one topic with one kind of command, the index in the Command variant. If
/// `on_command` throws Error, the command is invalid and has changed nothing.
struct Input {
  std::string topic;
  std::size_t kind = 0;
  std::function<void(const Command&)> on_command;
  double low = -std::numeric_limits<double>::max();  // of a number
  double high = std::numeric_limits<double>::max();
  bool needs_one_publisher = false;  // commands are refused while several publish them
};

/// Pose of a satellite receiver's local frame: WGS-84, orientation in east-north-up.
struct GeoPose {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double altitude_m = 0.0;
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Service of a device. The request is empty, a vector (a bias), a geographic pose, or the time (s)
/// for which the state of a trajectory is requested. The caller gets the text of a thrown Error.
struct Service {
  using Act =
      std::variant<std::function<void()>, std::function<void(const Eigen::Vector3d&)>,
                   std::function<void(const GeoPose&)>, std::function<TrajectoryState(double)>>;
  std::string name;
  Act act;
};

/// A number of a device that may be changed while it runs.
struct TunableParameter {
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

/// A group of tunables under one name, as in dynamic_reconfigure.
struct ParameterGroup {
  std::string name;
  std::vector<TunableParameter> parameters;
};

/// Every kind of port; Ports::visit does not compile where a kind is not handled.
using Port = std::variant<Output, Input, Service, ParameterGroup, Action>;

/// All ports of a device, or of a controller that it has loaded.
class Ports {
 public:
  /// Adds a port; the reference stays valid as more are added.
  template <typename Kind>
  Kind& add(Kind port) {
    return std::get<Kind>(ports_.emplace_back(std::move(port)));
  }
  Output& add_output(const std::string& topic, std::size_t kind,
                     std::optional<double> rate_hz = std::nullopt,
                     const std::string& frame_id = "") {
    return add(Output{topic, kind, rate_hz, frame_id});
  }
  /// Adds an input of commands that need no check.
  template <typename T>
  Input& add_input(const std::string& topic, std::function<void(const T&)> act) {
    return add(Input{topic, command_kind<T>(), [act = std::move(act)](const Command& command) {
                       act(std::get<T>(command));
                     }});
  }
  /// Adds an input of velocities; one that is not finite is an Error.
  Input& add_velocity_input(const std::string& topic, std::function<void(const Twist&)> act);
  /// Adds an input of wrenches in the world's axes; one beyond the limits of the physics is an
  /// Error.
  Input& add_wrench_input(const std::string& topic,
                          std::function<void(const physics::ForceTorque&)> act);
  /// Adds an input of numbers within [low, high]; another number is an Error.
  Input& add_number_input(const std::string& topic, double low, double high,
                          std::function<void(double)> act);

  /// Calls for each port the one of `acts` that takes its kind, in the order of addition.
  template <typename... Acts>
  void visit(const Acts&... acts) {
    struct Overloads : Acts... {
      using Acts::operator()...;
    };
    const Overloads act{acts...};
    for (Port& port : ports_) std::visit(act, port);
  }
  /// Returns the ports of one kind, in the order of addition.
  template <typename Kind>
  std::vector<std::reference_wrapper<Kind>> all() {
    std::vector<std::reference_wrapper<Kind>> found;
    for (Port& port : ports_) {
      if (Kind* each = std::get_if<Kind>(&port)) found.push_back(*each);
    }
    return found;
  }

 private:
  std::deque<Port> ports_;
};

}  // namespace ardee::devices
