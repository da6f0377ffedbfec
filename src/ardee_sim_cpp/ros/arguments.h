// SPDX-License-Identifier: MIT
#pragma once

#include <ros/node_handle.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ardee_sim/devices/registry.h"

namespace ardee::node {

/// Command-line arguments of the simulator node; the node's parameters replace absent ones.
struct CommandLine {
  std::string world;
  std::optional<bool> paused;
  std::optional<std::uint64_t> seed;
  std::optional<bool> lenient;
  std::vector<std::string> model_paths;  // before those of the environment
  bool verbose = false;
  bool help = false;
};

/// Reads the command line, from which ROS's own arguments are left out. Throws Error for an unknown
/// argument.
CommandLine parse_command_line(int argc, char** argv);

/// Usage text of the node, for -h.
std::string usage();

/// The settings of the node.
struct Settings {
  std::string world;
  std::vector<std::string> model_paths;  // before those of the environment
  bool paused = false;
  std::uint64_t seed = 0;
  std::optional<double> real_time_factor;  // 0: as fast as the machine can; none: the world's
  int threads = 0;                         // of the ray casts; 0: all cores
  double clock_rate_hz = 100.0;            // of /clock, in simulated time; 0: each step
  bool publish_world_tf = false;
  bool lenient =
      false;  // leave missing or malformed parts out, with an error; else refuse the world
  double scenery_radius_m = 6.0;
  bool show_collisions = false;  // collision bodies in /ardee/scenery
  std::vector<devices::PluginAlias> plugin_aliases;
  int realtime_priority = 0;  // 1 to 99, of the threads that send messages; 0: none
};

/// The command line over the node's private parameters. Throws Error for a parameter of the wrong
/// type or out of bounds.
Settings read_settings(const CommandLine& command_line, const ros::NodeHandle& private_node);

}  // namespace ardee::node
