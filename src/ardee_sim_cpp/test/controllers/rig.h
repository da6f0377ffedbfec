// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ardee_sim/controllers/controller_types.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
using namespace physics;
using namespace devices;

constexpr double kPi = 3.14159265358979323846;

/// Returns a list of settings from names.
inline Setting::List names(const std::vector<std::string>& texts) {
  Setting::List list;
  for (const std::string& text : texts) list.push_back({"", text});
  return list;
}

/// Parameters of a controller "/base" by their paths below it: "linear/x/max_velocity".
using Parameters = std::map<std::string, Setting::Value>;
inline Setting settings_of(const Parameters& parameters, const std::string& path = "/base") {
  Setting::Map map;
  std::map<std::string, Parameters> groups;
  for (const auto& [key, value] : parameters) {
    const std::size_t slash = key.find('/');
    if (slash == std::string::npos) {
      map[key] = Setting(path + "/" + key, value);
    } else {
      groups[key.substr(0, slash)][key.substr(slash + 1)] = value;
    }
  }
  for (const auto& [key, group] : groups) map[key] = settings_of(group, path + "/" + key);
  return {path, map};
}

/// Returns the required parameters of a drive.
inline Parameters drive_parameters() {
  Setting::List zeros;
  for (int i = 0; i < 6; ++i) zeros.push_back({"", 0.0});
  return {{"pose_covariance_diagonal", zeros}, {"twist_covariance_diagonal", zeros}};
}

/// Returns the message of the exception that an act throws.
inline std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Controller over joints that are driven by hand, with its readings.
class Rig : public ReadingSink {
 public:
  static constexpr TimeNs kStepNs = 10'000'000;
  static constexpr double kStep_s = 0.01;

  void add_joint(const std::string& name, JointInterface interface,
                 JointType type = JointType::kContinuous) {
    JointHandle joint;
    joint.name = name;
    joint.interface = interface;
    joint.type = type;
    hardware[name] = joint;
  }
  JointHandle& joint(const std::string& name) { return hardware.at(name); }
  double command_of(const std::string& name) const { return hardware.at(name).command; }
  /// Adds a link with a collision, turned by a joint of that name, at a place in the model.
  void add_wheel(const std::string& name, const Eigen::Vector3d& place, const Geometry& geometry) {
    Link link;
    link.name = name + "_link";
    link.X_ML.p = place;
    link.collisions.push_back({"collision", {}, geometry, {}});
    model.links.push_back(link);
    Joint turning;
    turning.name = name;
    turning.type = JointType::kContinuous;
    turning.child = link.name;
    model.joints.push_back(turning);
  }

  void make(const std::string& type, const Parameters& parameters) {
    settings = settings_of(parameters);
    controller =
        controller_types().at(type)({"base", "/", settings, model, hardware, sensors, log});
  }
  void start(const std::string& type, const Parameters& parameters) {
    make(type, parameters);
    controller->start(now_ns);
    controller->set_running(true);
  }
  /// Returns the message of the exception that its construction throws.
  std::string refusal(const std::string& type, const Parameters& parameters) {
    return message_of([&] { make(type, parameters); });
  }
  void update() {
    now_ns += kStepNs;
    controller->update(now_ns, kStep_s, *this);
  }
  void update(int times) {
    for (int i = 0; i < times; ++i) update();
  }
  /// Turns the joints as commanded (rad/s); the controller follows.
  void roll(int times) {
    for (int i = 0; i < times; ++i) {
      for (auto& [name, joint] : hardware) {
        if (joint.interface != JointInterface::kVelocity) continue;
        joint.velocity = joint.command;
        joint.position += joint.command * kStep_s;
      }
      update();
    }
  }
  /// Expects the joints to turn as before after a reset and a return to the present state.
  void expect_repeats(int times) {
    const auto serialize = [&](StateArchive& state) {
      state(now_ns, *controller);
      for (auto& [name, joint] : hardware) state(joint);
    };
    const auto commands = [&] {
      readings.clear();
      std::vector<double> all;
      for (int i = 0; i < times; ++i) {
        roll(1);
        for (const auto& [name, joint] : hardware) all.push_back(joint.command);
        for (const auto& [topic, some] : readings) {
          const auto* odometry = std::get_if<OdometryReading>(&some.back());
          if (odometry) all.push_back(odometry->pose.p.x());
        }
      }
      return all;
    };
    StateArchive saved;
    serialize(saved);
    const std::vector<double> first = commands();
    controller->reset(now_ns);
    controller->start(now_ns);
    StateArchive restored(saved.bytes());
    serialize(restored);
    EXPECT_EQ(commands(), first);
    EXPECT_GT(*std::max_element(first.begin(), first.end()), 0.0);
  }
  void send(const std::string& topic, const Command& command) {
    for (const Input& input : controller->ports().all<Input>()) {
      if (input.topic == topic) return input.on_command(command);
    }
    FAIL() << "no input " << topic;
  }
  void drive(double v_m_per_s, double w_rad_per_s) {
    send("/base/cmd_vel", Twist{{v_m_per_s, 0, 0}, {0, 0, w_rad_per_s}});
  }
  TunableParameter& tunable(const std::string& name) {
    for (ParameterGroup& tuning : controller->ports().all<ParameterGroup>()) {
      for (TunableParameter& each : tuning.parameters) {
        if (each.name == name) return each;
      }
    }
    throw Error("no tunable " + name);
  }

  void on_reading(const Output& output, const Reading& reading) override {
    readings[output.topic].push_back(reading);
  }
  std::size_t count(const std::string& topic) { return readings[topic].size(); }
  template <typename T>
  const T& last(const std::string& topic) {
    return std::get<T>(readings.at(topic).back());
  }
  bool publishes(const std::string& topic) {
    for (const Output& output : controller->ports().all<Output>()) {
      if (output.topic == topic) return true;
    }
    return false;
  }

  Hardware hardware;
  SensorHandles sensors;
  Model model;
  std::vector<std::string> messages;
  Log log{[this](LogLevel, const std::string& text) { messages.push_back(text); }};
  Setting settings;
  std::unique_ptr<Controller> controller;
  TimeNs now_ns = 0;
  std::map<std::string, std::vector<Reading>> readings;
};

}  // namespace ardee::control
