// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/devices/wheel_encoder.h"

namespace ardee::devices {

/// libardee_ros_encoder.so (thesis 4.3.1, Listing A.5): one encoder on a joint, with its own topic.
class Encoder : public Device {
 public:
  static std::unique_ptr<Device> make(const PluginDescription& plugin, Parameters& parameters,
                                      DeviceContext& context);
  Encoder(const std::string& name, const std::string& topic, const WheelEncoder::Params& params,
          double rate_hz, Robot& robot);

  void after_step(TimeNs now_ns, ReadingSink& sink) override;
  void reset(TimeNs now_ns) override;
  void serialize(StateArchive& state) override { state(encoder_, timer_); }

 private:
  WheelEncoder encoder_;
  RateTimer timer_;
  Output& output_;
};

}  // namespace ardee::devices
