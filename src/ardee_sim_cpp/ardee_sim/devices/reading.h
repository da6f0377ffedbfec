// SPDX-License-Identifier: MIT
#pragma once

#include <variant>

#include "ardee_sim/devices/control_readings.h"
#include "ardee_sim/devices/force_readings.h"
#include "ardee_sim/devices/image_readings.h"
#include "ardee_sim/devices/motion_readings.h"
#include "ardee_sim/devices/power_readings.h"
#include "ardee_sim/devices/range_readings.h"

namespace ardee::devices {

/// Any reading that a device may give.
using Reading =
    std::variant<LidarReading, OdometryReading, TransformReading, JointStateReading, ImuReading,
                 FixReading, VectorReading, MagneticFieldReading, EncoderReading, BatteryReading,
                 BatteryStateReading, RangeReading, PointCloudReading, LegacyCloudReading,
                 ImageReading, CameraInfoReading, GpsQualityReading, RegionsReading, TwistReading,
                 JointControllerReading, TrajectoryControllerReading, FourWheelSteeringReading,
                 ContactsReading, WrenchReading>;

}  // namespace ardee::devices
