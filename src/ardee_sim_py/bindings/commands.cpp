// SPDX-License-Identifier: MIT
#include "commands.h"

#include <pybind11/stl.h>

#include <array>

#include "arrays.h"

namespace ardee::python {
namespace {

using namespace devices;
using namespace pybind11::literals;
using Numbers = std::vector<double>;

// In the order of the Command variant.
constexpr std::array kNames = {"trigger",         "Twist",           "number",          "bool",
                               "list of numbers", "SteeringCommand", "JointTrajectory", "Wrench"};
static_assert(kNames.size() == std::variant_size_v<Command>);

[[noreturn]] void refuse(const py::object& value, const std::string& expected) {
  const auto shown = py::repr(value)[py::slice(0, 80, 1)].cast<std::string>();
  throw py::type_error("found " + shown + ", expected " + expected);
}

template <typename T>
T cast(const py::object& value, const std::string& expected) {
  try {
    return value.cast<T>();
  } catch (const py::cast_error&) {
    refuse(value, expected);
  } catch (const py::error_already_set&) {  // of an array without dimensions
    refuse(value, expected);
  }
}

Numbers numbers(const py::object& value, std::size_t count, const std::string& expected) {
  Numbers found = cast<Numbers>(value, expected);
  if (found.size() != count) refuse(value, expected);
  return found;
}

std::pair<Eigen::Vector3d, Eigen::Vector3d> two_vectors(const py::object& value,
                                                        const std::string& expected) {
  const Numbers six = numbers(value, 6, expected);
  return {{six[0], six[1], six[2]}, {six[3], six[4], six[5]}};
}

Numbers list_in(const py::dict& from, const char* key) {
  return from.contains(key) ? cast<Numbers>(from[key], std::string(key) + ": a list of numbers")
                            : Numbers{};
}

JointTrajectory trajectory(const py::object& value) {
  const std::string expected =
      "a dict with joints (names) and points (dicts with positions, velocities, accelerations, "
      "efforts, time_from_start_s), and start_s if not at once";
  const auto from = cast<py::dict>(value, expected);
  if (!from.contains("joints") || !from.contains("points")) refuse(value, expected);
  JointTrajectory made;
  if (from.contains("start_s")) made.start_s = cast<double>(from["start_s"], "start_s: a number");
  made.joints = cast<std::vector<std::string>>(from["joints"], "joints: a list of names");
  for (const auto& each : cast<std::vector<py::dict>>(from["points"], "points: a list of dicts")) {
    JointTrajectoryPoint point{list_in(each, "positions"), list_in(each, "velocities"),
                               list_in(each, "accelerations"), list_in(each, "efforts"), 0.0};
    if (each.contains("time_from_start_s")) {
      point.time_from_start_s =
          cast<double>(each["time_from_start_s"], "time_from_start_s: a number");
    }
    made.points.push_back(std::move(point));
  }
  return made;
}

py::dict dict_of(const TrajectoryState& state) {
  return py::dict("names"_a = state.names, "positions"_a = hold(state.positions),
                  "velocities"_a = hold(state.velocities),
                  "accelerations"_a = hold(state.accelerations));
}

void require_count(const py::args& arguments, std::size_t count, const std::string& expected) {
  if (arguments.size() != count) refuse(arguments, expected);
}

}  // namespace

const char* command_name(std::size_t kind) { return kNames.at(kind); }

Command to_command(std::size_t kind, const py::object& value) {
  switch (kind) {
    case command_kind<Trigger>():
      if (!value.is_none()) refuse(value, "no value: trigger(topic)");
      return Trigger{};
    case command_kind<Twist>(): {
      const auto [linear, angular] = two_vectors(value, "a Twist");
      return Twist{linear, angular};
    }
    case command_kind<double>():
      return cast<double>(value, "a number");
    case command_kind<bool>():
      return cast<bool>(value, "True or False");
    case command_kind<Numbers>():
      return cast<Numbers>(value, "a list of numbers");
    case command_kind<SteeringCommand>(): {
      const Numbers three = numbers(value, 3, "front_angle_rad, rear_angle_rad, speed_m_s");
      return SteeringCommand{three[0], three[1], three[2]};
    }
    case command_kind<JointTrajectory>():
      return trajectory(value);
    case command_kind<physics::ForceTorque>(): {
      const auto [force, torque] = two_vectors(value, "six numbers: force in N, torque in N m");
      return physics::ForceTorque{force, torque};
    }
    default:
      throw std::logic_error("found a kind of command that Python cannot give");
  }
}

py::object call(const Service& service, const py::args& arguments) {
  return std::visit(
      [&](const auto& act) -> py::object {
        using Act = std::decay_t<decltype(act)>;
        if constexpr (std::is_same_v<Act, std::function<void()>>) {
          require_count(arguments, 0, "no argument");
          act();
        } else if constexpr (std::is_same_v<Act, std::function<void(const Eigen::Vector3d&)>>) {
          require_count(arguments, 3, "three numbers");
          act({cast<double>(arguments[0], "a number"), cast<double>(arguments[1], "a number"),
               cast<double>(arguments[2], "a number")});
        } else if constexpr (std::is_same_v<Act, std::function<void(const GeoPose&)>>) {
          require_count(arguments, 3, "latitude_deg, longitude_deg, altitude_m");
          act({cast<double>(arguments[0], "a number"), cast<double>(arguments[1], "a number"),
               cast<double>(arguments[2], "a number"), Eigen::Quaterniond::Identity()});
        } else {
          require_count(arguments, 1, "a time in s");
          return dict_of(act(cast<double>(arguments[0], "a number")));
        }
        return py::none();
      },
      service.act);
}

}  // namespace ardee::python
