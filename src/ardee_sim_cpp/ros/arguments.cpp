// SPDX-License-Identifier: MIT
#include "ros/arguments.h"

#include <getopt.h>
#include <ros/init.h>

#include <charconv>
#include <cmath>
#include <limits>

#include "ardee_sim/core/error.h"
#include "ros/setting_from_ros.h"

namespace ardee::node {
namespace {

constexpr char kSeeHelp[] = " (--help lists all arguments)";

std::uint64_t parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, seed);
  if (error != std::errc() || stopped != end) {
    throw Error("found seed '" + text + "', expected a whole number from 0");
  }
  return seed;
}

/// The parameter's value, or `fallback` if it is not set.
template <typename Value>
Value parameter(const ros::NodeHandle& node, const std::string& name, const Value& fallback,
                const std::string& expected) {
  Value value = fallback;
  if (node.hasParam(name) && !node.getParam(name, value)) {
    throw Error("parameter " + node.resolveName(name) + ": expected " + expected);
  }
  return value;
}

double number(const ros::NodeHandle& node, const std::string& name, double fallback, double low,
              double high) {
  const std::string expected =
      "a number from " + std::to_string(low) + " to " + std::to_string(high);
  const double value = parameter(node, name, fallback, expected);
  if (!(value >= low && value <= high)) {
    throw Error("parameter " + node.resolveName(name) + ": found " + std::to_string(value) +
                ", expected " + expected);
  }
  return value;
}

/// Reads an integer as a double: ROS silently rounds a double that is read as an int.
int whole_number(const ros::NodeHandle& node, const std::string& name, int fallback,
                 int high = std::numeric_limits<int>::max()) {
  const std::string expected = "a whole number from 0 to " + std::to_string(high);
  const double value = parameter<double>(node, name, fallback, expected);
  if (!(value >= 0.0 && value <= high && value == std::floor(value))) {
    throw Error("parameter " + node.resolveName(name) + ": found " + std::to_string(value) +
                ", expected " + expected);
  }
  return static_cast<int>(value);
}

/// ~plugin_aliases: a list, so that a file name need not be a valid parameter name.
std::vector<devices::PluginAlias> read_aliases(const ros::NodeHandle& node) {
  const Setting list = setting_from_ros(node.resolveName("plugin_aliases"));
  return list ? devices::read_plugin_aliases(list) : std::vector<devices::PluginAlias>();
}

}  // namespace

std::string usage() {
  return "usage: simulator [WORLD] [-u | --paused] [--seed N] [--model-path DIR] [--lenient]\n"
         "                 [--verbose] [-h]\n"
         "Simulates a world and its robots on the ROS network.\n"
         "  WORLD             world file (SDF 1.2 to 1.12): a path, or a name below\n"
         "                    GAZEBO_RESOURCE_PATH; default: the parameter ~world\n"
         "  -u, --paused      start with the clock stopped\n"
         "  --seed N          root of all random numbers, a whole number from 0 (default 0)\n"
         "  --model-path DIR  folder of models to search before GAZEBO_MODEL_PATH; may be given "
         "again\n"
         "  --lenient         leave out each file, model, include or light that is missing or\n"
         "                    written wrong, with an error; by default the whole world is refused\n"
         "  --verbose         log at debug level\n"
         "  -h, --help        this text\n"
         "Parameters: ~world ~paused ~seed ~real_time_factor ~threads ~pub_clock_frequency\n"
         "            ~publish_world_tf ~lenient ~scenery_radius ~show_collisions\n"
         "            ~realtime_priority ~verbose\n"
         "            ~plugin_aliases (list of filename, plugin, keys: plugins of other names)\n";
}

CommandLine parse_command_line(int argc, char** argv) {
  std::vector<std::string> words;
  ros::removeROSArgs(argc, argv, words);
  std::vector<char*> own;
  for (std::string& word : words) own.push_back(word.data());
  static const option kOptions[] = {{"paused", no_argument, nullptr, 'u'},
                                    {"seed", required_argument, nullptr, 's'},
                                    {"lenient", no_argument, nullptr, 'l'},
                                    {"verbose", no_argument, nullptr, 'v'},
                                    {"model-path", required_argument, nullptr, 'm'},
                                    {"help", no_argument, nullptr, 'h'},
                                    {nullptr, 0, nullptr, 0}};
  CommandLine line;
  opterr = 0;
  const int count = static_cast<int>(own.size());
  for (int found = 0; (found = getopt_long(count, own.data(), ":uh", kOptions, nullptr)) != -1;) {
    switch (found) {
      case 'u':
        line.paused = true;
        break;
      case 's':
        line.seed = parse_seed(optarg);
        break;
      case 'l':
        line.lenient = true;
        break;
      case 'v':
        line.verbose = true;
        break;
      case 'm':
        line.model_paths.emplace_back(optarg);
        break;
      case 'h':
        line.help = true;
        break;
      case ':':
        throw Error(std::string("found no value after ") + own[optind - 1]);
      default:
        throw Error(std::string("found unknown argument ") + own[optind - 1] + kSeeHelp);
    }
  }
  if (count - optind > 1) throw Error(std::string("found more than one world") + kSeeHelp);
  if (optind < count) line.world = own[optind];
  return line;
}

Settings read_settings(const CommandLine& command_line, const ros::NodeHandle& node) {
  Settings settings;
  settings.world = command_line.world;
  settings.model_paths = command_line.model_paths;
  if (settings.world.empty()) {
    settings.world = parameter<std::string>(node, "world", "", "the path of a world file");
  }
  if (settings.world.empty()) throw Error(std::string("found no world file") + kSeeHelp);
  settings.paused = command_line.paused.value_or(parameter(node, "paused", false, "true or false"));
  settings.seed = command_line.seed ? *command_line.seed
                                    : static_cast<std::uint64_t>(whole_number(node, "seed", 0));
  const double factor = number(node, "real_time_factor", -1.0, -1e9, 1e9);
  if (factor >= 0.0) settings.real_time_factor = factor;
  settings.threads = whole_number(node, "threads", 0);
  settings.clock_rate_hz = number(node, "pub_clock_frequency", settings.clock_rate_hz, 0.0, 1e9);
  settings.publish_world_tf = parameter(node, "publish_world_tf", false, "true or false");
  settings.lenient =
      command_line.lenient.value_or(parameter(node, "lenient", false, "true or false"));
  settings.scenery_radius_m = number(node, "scenery_radius", settings.scenery_radius_m, 0.0, 1e4);
  settings.show_collisions = parameter(node, "show_collisions", false, "true or false");
  settings.plugin_aliases = read_aliases(node);
  constexpr int kHighestPriority = 99;  // of SCHED_RR
  settings.realtime_priority = whole_number(node, "realtime_priority", 0, kHighestPriority);
  return settings;
}

}  // namespace ardee::node
