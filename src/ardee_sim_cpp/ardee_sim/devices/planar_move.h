// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/drive_command.h"
#include "ardee_sim/devices/odometry_publisher.h"

namespace ardee::devices {

/// libgazebo_ros_planar_move.so: moves the model in the plane as commanded, forwards, sideways and
/// turning, on any ground; gravity still acts.
class PlanarMove : public Device {
 public:
  struct Params {
    double command_timeout_s = 0.0;  // 0: the last command stays
    std::string command_topic;
    std::optional<OdometryPublisher::Params> odometry;
  };

  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  PlanarMove(const std::string& name, const Params& params, Robot& robot);

  void before_step(TimeNs now_ns) override;
  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override { state(command_, odometry_); }

 private:
  Params params_;
  Robot& robot_;
  DriveCommand command_;
  std::optional<OdometryPublisher> odometry_;
};

}  // namespace ardee::devices
