// SPDX-License-Identifier: MIT
#pragma once

#include "ardee_sim/core/rng.h"
#include "ardee_sim/core/time.h"
#include "ardee_sim/devices/registry.h"

/// Roll and pitch of a robot in rad, as x and y of a VectorReading, with Gaussian noise.
class Inclinometer : public ardee::devices::Device {
 public:
  struct Params {
    std::string topic;
    double rate_hz = 50.0;
    double noise_std_rad = 0.0;
  };

  /// Makes the device from `<plugin filename="libinclinometer.so">` with topicName, updateRate,
  /// gaussianNoise.
  static std::unique_ptr<ardee::devices::Device> make(const ardee::PluginDescription& plugin,
                                                      ardee::Parameters& parameters,
                                                      ardee::devices::DeviceContext& context);
  Inclinometer(const std::string& name, const Params& params, std::uint64_t seed,
               const ardee::devices::Robot& robot);

  void after_step(ardee::TimeNs now_ns, ardee::devices::ReadingSink& sink) override;
  void reset(ardee::TimeNs now_ns) override;
  void serialize(ardee::StateArchive& state) override { state(timer_); }

 private:
  const Params params_;
  const ardee::CounterRng noise_;
  const ardee::devices::Robot& robot_;
  ardee::RateTimer timer_;
  ardee::devices::Output& output_;
};
