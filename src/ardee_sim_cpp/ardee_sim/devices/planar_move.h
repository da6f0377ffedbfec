// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/drive_command.h"

namespace ardee::devices {

/// libgazebo_ros_planar_move.so: moves the model over the plane as commanded, forwards, sideways
/// and turning, whatever it stands on; gravity acts as ever.
class PlanarMove : public Device {
 public:
  struct Params {
    double odometry_rate_hz = 20.0;  // 0: no odometry
    double command_timeout_s = 0.0;  // 0: the last command stays
    std::string command_topic;
    std::string odometry_topic;
    std::string odometry_frame;
    std::string base_frame;
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, DeviceContext& context);
  PlanarMove(const std::string& name, const Params& params, Robot& robot);

  void before_step(TimeNs now_ns) override;
  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;

 private:
  Params params_;
  Robot& robot_;
  DriveCommand command_;
  RateTimer odometry_timer_;
  Output* odometry_output_ = nullptr;
  Output* tf_output_ = nullptr;
};

}  // namespace ardee::devices
