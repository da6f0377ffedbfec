// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/devices/names.h"
#include "ardee_sim/devices/wheel_odometry.h"

namespace ardee::devices {

/// Publisher of a drive's odometry and of the transform between its frames.
class OdometryPublisher {
 public:
  struct Params {
    double rate_hz = 100.0;                       // 0: at each step
    std::optional<WheelOdometry::Params> wheels;  // none: of the true motion
    bool has_message = true;
    bool has_transform = true;
    bool is_level = false;  // the message's pose has no height, but the transform's has
    std::string topic;
    std::string frame;
    std::string base_frame;
    /// x, y, z, roll, pitch, yaw; the stock plugins give none for the twist.
    std::array<double, 6> pose_covariance = {1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3};
    std::array<double, 6> twist_covariance{};
  };

  OdometryPublisher(const Params& params, Ports& ports, Robot& robot);

  bool due(TimeNs now_ns) { return timer_.due(now_ns); }
  /// Publishes; to be called when due.
  void publish(TimeNs now_ns, ReadingSink& sink);
  void reset(TimeNs now_ns);
  void serialize(StateArchive& state) { state(timer_, wheels_); }

 private:
  OdometryReading measure(TimeNs now_ns);

  Params params_;
  Robot& robot_;
  RateTimer timer_;
  std::optional<WheelOdometry> wheels_;
  Output* output_ = nullptr;
  Output* tf_output_ = nullptr;
};

/// <odometryTopic>, <odometryFrame> and <robotBaseFrame>.
OdometryPublisher::Params read_odometry_params(
    Parameters& parameters, const std::string& robot_namespace, const DeviceContext& context,
    const char* base_frame, WithoutPrefix without_prefix = WithoutPrefix::kNothing);

/// Whether <odometrySource> is encoder, the turns of the wheels, and not world, the truth (the
/// stock plugins' default). Their numbers are 0 and 1.
bool reads_wheels(Parameters& parameters);

}  // namespace ardee::devices
