// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "ardee_sim/devices/reading_header.h"

namespace ardee::devices {

/// A rotary encoder on a wheel: angle in rad, speed of the wheel's rim in m/s, quadrature pulses
/// per second.
struct EncoderReading {
  Header header;
  std::int32_t id = 0;
  double position_rad = 0.0;
  double speed_m_per_s = 0.0;
  double pulses_per_s = 0.0;
};

/// Terminal voltage of a battery and its bounds, in V.
struct BatteryReading {
  Header header;
  double voltage_V = 0.0;
  double voltage_max_V = 0.0;
  double voltage_min_V = 0.0;
};

/// Battery in the layout of sensor_msgs/BatteryState: voltage in V, current in A, negative while
/// discharging, charges in Ah; NaN where not modelled.
struct BatteryStateReading {
  Header header;
  double voltage_V = 0.0;
  double current_A = 0.0;
  double charge_Ah = 0.0;
  double capacity_Ah = 0.0;
  double design_capacity_Ah = 0.0;
  double percentage = 0.0;  // 0 to 1
  std::string location;
};

}  // namespace ardee::devices
