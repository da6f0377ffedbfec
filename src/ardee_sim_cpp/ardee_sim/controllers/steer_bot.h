// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ardee_sim/controllers/hardware.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/description/setting.h"

namespace ardee::control {

/// steer_bot_hardware_gazebo/SteerBotHardwareGazebo: controllers see the wheel and the steering of
/// a bicycle, and the car's wheels and knuckles follow them. Its parameters are below
/// <robot_namespace>/steer_bot_hardware_gazebo.
class SteerBot {
 public:
  static constexpr char kType[] = "steer_bot_hardware_gazebo/SteerBotHardwareGazebo";

  /// Throws Error if a parameter is missing or wrong, or names a joint that the car does not have.
  SteerBot(const Setting& settings, const Model& model, Log& log);

  /// Joints of the bicycle and of the car.
  const std::map<std::string, JointInterface>& joints() const { return joints_; }
  /// Passes the bicycle's commands on to the car. A joint of the bicycle that the car does not have
  /// follows its command at once.
  void follow(Hardware& hardware, double dt_s) const;
  /// Resets those joints of the bicycle that the car does not have.
  void reset(Hardware& hardware) const;

 private:
  struct Knuckle {
    std::string joint;
    double y_m;  // left of the middle; 0: all knuckles turn alike
  };

  std::map<std::string, JointInterface> joints_;
  std::string rear_wheel_;
  std::string front_steer_;
  bool has_rear_wheel_ = false;
  bool has_front_steer_ = false;
  std::vector<std::string> wheels_;
  std::vector<Knuckle> knuckles_;
  double wheel_base_m_ = 1.0;
};

}  // namespace ardee::control
