// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/wheel_encoder.h"

#include <cmath>

#include "ardee_sim/core/limits.h"

namespace ardee::devices {
namespace {

constexpr double kTurn_rad = 2.0 * M_PI;
/// Tolerance in pulses: an angle that misses an edge by rounding only counts as past it.
constexpr double kEdge = 1e-6;

}  // namespace

double WheelEncoder::pulses() const {
  const double angle_rad = robot_.dynamics().joint_position(params_.joint);
  return std::floor(angle_rad / kTurn_rad * params_.pulses_per_turn + kEdge);
}

EncoderReading WheelEncoder::read(TimeNs now_ns) {
  EncoderReading reading;
  reading.header = {now_ns, params_.frame};
  reading.id = params_.id;
  double rate_rad_per_s = 0.0;
  if (params_.ideal) {
    reading.position_rad = robot_.dynamics().joint_position(params_.joint);
    rate_rad_per_s = robot_.dynamics().joint_velocity(params_.joint);
  } else {
    const double rad_per_pulse = kTurn_rad / params_.pulses_per_turn;
    const Count now{now_ns, pulses()};
    const TimeNs start_ns = now_ns - nanoseconds(params_.speed_window_s);
    while (counts_.size() > 1 && counts_[1].time_ns <= start_ns) counts_.pop_front();
    if (params_.speed_window_s <= 0.0) counts_.erase(counts_.begin(), counts_.end() - 1);
    const double elapsed_s = seconds(now_ns - counts_.front().time_ns);
    if (elapsed_s > 0.0) {
      rate_rad_per_s = (now.pulses - counts_.front().pulses) * rad_per_pulse / elapsed_s;
    }
    counts_.push_back(now);
    reading.position_rad = now.pulses * rad_per_pulse;
  }
  reading.speed_m_per_s = rate_rad_per_s * params_.wheel_diameter_m / 2.0;
  reading.pulses_per_s = rate_rad_per_s * params_.pulses_per_turn / kTurn_rad;
  return reading;
}

void WheelEncoder::reset(TimeNs now_ns) { counts_ = {{now_ns, pulses()}}; }

std::size_t turning_joint(const DeviceContext& context, const std::string& name,
                          const Source& source) {
  const std::size_t joint = context.joint_index(name, source);
  if (!turns(context.robot.model().joints[joint].type)) {
    throw Error(source, "found joint '" + name +
                            "', which does not turn, expected a continuous or revolute one");
  }
  return joint;
}

std::size_t plugin_turning_joint(Parameters& parameters, const DeviceContext& context,
                                 const char* key, const char* fallback) {
  const Element* given = parameters.block(key);
  return turning_joint(context, given ? given->text : fallback,
                       given ? given->source : parameters.source());
}

WheelEncoder::Params read_encoder_params(Parameters& parameters) {
  constexpr double kMostPulses = 1e7;
  constexpr double kLongest_s = 10.0;
  WheelEncoder::Params params;
  params.wheel_diameter_m = parameters.number("wheelDiameter", 0.15, limits::kSmallestWheel_m);
  params.pulses_per_turn = parameters.number("pulsesPR", 150.0, 1.0, kMostPulses);
  params.speed_window_s = parameters.number("speedWindow", params.speed_window_s, 0.0, kLongest_s);
  params.ideal = parameters.boolean("ideal", false);
  return params;
}

}  // namespace ardee::devices
