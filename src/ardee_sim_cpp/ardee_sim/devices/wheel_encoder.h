// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <memory>
#include <string>

#include "ardee_sim/core/state_archive.h"
#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// A rotary encoder on a wheel's joint. It counts whole pulses: the angle is a multiple of one
/// pulse, and speeds are pulses counted over a short window, as a motor controller derives them.
class WheelEncoder {
 public:
  struct Params {
    std::size_t joint = 0;
    int id = 0;
    double wheel_diameter_m = 0.15;
    double pulses_per_turn = 150.0;
    double speed_window_s = 0.1;  // 0: the time between readings
    bool ideal = false;           // exact angle and speed of the joint, not in pulses
    std::string frame;
  };

  WheelEncoder(const Params& params, Robot& robot) : params_(params), robot_(robot) { reset(0); }

  EncoderReading read(TimeNs now_ns);
  /// Restarts the count at the wheel's present angle; reported angles remain those of the joint.
  void reset(TimeNs now_ns);
  void serialize(StateArchive& state) { state(counts_); }

 private:
  struct Count {
    TimeNs time_ns = 0;
    double pulses = 0.0;
  };
  double pulses() const;

  Params params_;
  Robot& robot_;
  std::deque<Count> counts_;  // within the window, oldest first, at least one
};

/// The joint called `name`, which must turn; `source` is where the name was found.
std::size_t turning_joint(const DeviceContext& context, const std::string& name,
                          const Source& source);

/// The turning joint that a model plugin's key names.
std::size_t plugin_turning_joint(Parameters& parameters, const DeviceContext& context,
                                 const char* key, const char* fallback);

/// The keys that all encoders have: wheelDiameter, pulsesPR, speedWindow, ideal.
WheelEncoder::Params read_encoder_params(Parameters& parameters);

}  // namespace ardee::devices
