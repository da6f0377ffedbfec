// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "motion_rig.h"

namespace ardee {
using namespace devices;

inline std::string gps(const std::string& keys) {
  return plugin("gazebo_ros_gps_with_dropout",
                "<topicName>gps/fix</topicName><updateRate>10</updateRate>" + keys);
}

inline std::string band(const std::string& r1, const std::string& r2, const std::string& rest) {
  return "<biomass_height_noise_coefficient><r1>" + r1 + "</r1><r2>" + r2 + "</r2>" + rest +
         "</biomass_height_noise_coefficient>";
}

inline std::string bands(const std::string& all) {
  return "<field_gps_noise_characteristics>" + all + "</field_gps_noise_characteristics>";
}

/// Returns a plot, 20 m along its rows, 6 m across.
inline std::string plot(const std::string& id, double x, double height_m,
                        double rotation_rad = 0.0) {
  return "<plot><plot_id>" + id + "</plot_id><plot_range_index>0</plot_range_index>" +
         "<plot_crossrange_index>0</plot_crossrange_index><x>" + std::to_string(x) +
         "</x><y>0</y><z>0</z><rotation>" + std::to_string(rotation_rad) +
         "</rotation><row_count>8</row_count><row_width>0.75</row_width>"
         "<row_length>20</row_length><average_height>" +
         std::to_string(height_m) + "</average_height><average_density>7</average_density></plot>";
}

inline Pose at(double x, double y = 0.0, double z = 0.5) {
  return Pose::from_xyz_rpy({x, y, z}, {0, 0, 0});
}

inline std::vector<GpsQualityReading> quality(TestWorld& world) {
  return world.recorder().on<GpsQualityReading>("/gps/data");
}

/// Returns quality readings of a robot that stands still for a number of samples.
inline std::vector<GpsQualityReading> stand(const std::string& keys, const Pose& pose,
                                            std::size_t count) {
  TestWorld world(free_space(0.0), 0.1);
  world.spawn(still(gps(keys)), "ball", pose);
  for (const std::string& message : world.messages()) ADD_FAILURE() << message;
  for (std::size_t i = 0; i < count; ++i) world->step();
  return quality(world);
}

inline const std::string kTwoPlots = plot("7", 0.0, 1.5) + plot("8", 30.0, 2.5);
inline const std::string kBands = bands(band("0", "2", "<mean>1</mean><variance>4</variance>") +
                                        band("2", "-1", "<mean>1</mean><variance>25</variance>"));

}  // namespace ardee
