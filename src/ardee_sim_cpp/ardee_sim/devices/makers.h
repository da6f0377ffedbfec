// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// Makers of devices. They read the plugin's keys from the Parameters that they are given.
using MakeOnModel = std::unique_ptr<Device>(const PluginDescription&, Parameters&, DeviceContext&);
using MakeOnSensor = std::unique_ptr<Device>(const SensorDescription&, Parameters&,
                                             std::size_t link, DeviceContext&);
using MakeInScene = std::unique_ptr<Device>(const SensorDescription&, Parameters&, std::size_t link,
                                            raycast::SceneKind, DeviceContext&);

// Each is defined in the file of its name, with the class of its device.
MakeOnModel make_battery, make_diff_drive, make_encoder, make_force_torque, make_gps_with_dropout,
    make_ground_truth, make_hector_imu, make_imu_on_model, make_joint_position,
    make_joint_state_publisher, make_link_force, make_link_push, make_magnetometer,
    make_mimic_joint, make_planar_move, make_torsional_spring, make_tricycle_drive;
MakeOnSensor make_block_lidar, make_bumper, make_imu_on_sensor, make_range_finder, make_sonar;
MakeInScene make_lidar, make_velodyne_lidar;

}  // namespace ardee::devices
