// SPDX-License-Identifier: MIT
#include "ros/simulator_node.h"

#include <ros/package.h>
#include <ros/ros.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>

#include "ardee_sim/readers/start_pose.h"
#include "ros/log_to_ros.h"
#include "ros/setting_from_ros.h"

namespace ardee::node {
namespace {

constexpr char kNodeName[] = "gazebo";  // users' code calls its private services by this name
constexpr int kBadInput = 2;

std::optional<std::string> find_package(const std::string& package) {
  const std::string path = ros::package::getPath(package);
  return path.empty() ? std::nullopt : std::optional<std::string>(path);
}

ResourceLocator make_locator() {
  ResourceLocator locator = ResourceLocator::from_environment();
  locator.set_package_finder(find_package);
  return locator;
}

/// A name without a scheme is searched below Gazebo's paths, like file://.
std::string world_uri(const std::string& world) {
  return world.find("://") == std::string::npos ? "file://" + world : world;
}

/// A world file by its path, or by its name below Gazebo's resource paths.
World load_world(Loader& loader, const std::string& world) {
  const std::filesystem::path path(world);
  if (std::filesystem::exists(path)) return loader.load_world(world);
  if (path.is_absolute()) throw Error("found no file " + world + ", expected a world file");
  std::string found;
  try {
    found = make_locator().resolve(world_uri(world), Source{});
  } catch (const FileError&) {
    throw Error("found no world '" + world +
                "', expected a file, here or below a folder of GAZEBO_RESOURCE_PATH");
  }
  return loader.load_world(found);
}

BadParts bad_parts(bool lenient) { return lenient ? BadParts::kLeaveOut : BadParts::kRefuse; }

/// tf_prefix of a namespace or of one around it, as tf::resolve finds it.
std::string tf_prefix(const std::string& robot_namespace) {
  std::string why;
  if (!ros::names::validate("/" + robot_namespace, why)) {
    throw Error("found '" + robot_namespace + "' as a namespace, expected a valid name: " + why);
  }
  const ros::NodeHandle node("/" + robot_namespace);
  std::string key;
  std::string prefix;
  if (node.searchParam("tf_prefix", key)) node.getParam(key, prefix);
  return prefix;
}

SimulationOptions simulation_options(const Settings& settings) {
  SimulationOptions options;
  options.seed = settings.seed;
  options.rays.threads = settings.threads;
  options.bad_parts = bad_parts(settings.lenient);
  options.frame_prefix = tf_prefix;
  options.parameter = setting_from_ros;
  options.plugin_aliases = settings.plugin_aliases;
  return options;
}

void use_simulated_time() {
  if (!ros::param::has("/use_sim_time")) ros::param::set("/use_sim_time", true);
}

/// Gives roscpp's threads, which write messages to sockets, priority over the computation;
/// otherwise the one that writes an image would wait for rendering threads. It applies to roscpp's
/// threads only if it is called before other threads exist. It acts only on request: while another
/// thread holds roscpp's lock, the sending thread spins, and on a machine without an idle core it
/// would block the other one.
void let_messages_go_first(int realtime_priority) {
  const sched_param priority{realtime_priority};
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    const pid_t thread = std::stoi(task.path().filename());
    if (thread == getpid()) continue;
    if (sched_setscheduler(thread, SCHED_RR | SCHED_RESET_ON_FORK, &priority) != 0) {
      ROS_WARN_STREAM("realtime_priority: not granted (" << std::strerror(errno)
                                                         << "); going on without");
      return;
    }
  }
}

/// Tells where a robot starts in this world; a parameter of an earlier world is removed.
void set_start_pose(const ros::NodeHandle& node, const std::string& world_file) {
  const std::optional<StartPose> pose = read_start_pose(world_file);
  node.deleteParam("start_pose");
  if (!pose) return;
  node.setParam(
      "start_pose",
      std::map<std::string, double>{
          {"x_m", pose->x_m}, {"y_m", pose->y_m}, {"z_m", pose->z_m}, {"yaw_rad", pose->yaw_rad}});
}

void log_at_debug_level() {
  if (ros::console::set_logger_level(ROSCONSOLE_DEFAULT_NAME, ros::console::levels::Debug)) {
    ros::console::notifyLoggerLevelsChanged();
  }
}

}  // namespace

SimulatorNode::SimulatorNode(const Settings& settings, ros::NodeHandle private_node)
    : messages_(log_to_ros()),
      loader_(make_locator(), Log(messages_.sink()), bad_parts(settings.lenient)),
      simulation_(load_world(loader_, settings.world), simulation_options(settings),
                  messages_.sink()),
      frames_(settings.publish_world_tf),
      metrics_(private_node),
      topics_(frames_, metrics_, Log(messages_.sink())),
      states_(private_node, simulation_),
      clock_(settings.clock_rate_hz),
      scenery_(simulation_, settings.scenery_radius_m),
      runner_(simulation_, {topics_, states_, clock_, frames_},
              [this] {
                scenery_.update();
                metrics_.publish(simulation_.now_ns());
              }),
      context_{simulation_, loader_, topics_, runner_, messages_},
      servers_(private_node) {
  for (const auto& entity : simulation_.entities()) topics_.add(*entity);
  simulation_.set_sink(&topics_);
  if (settings.real_time_factor) {
    PhysicsParams physics = simulation_.physics();
    physics.real_time_update_rate_hz = *settings.real_time_factor / physics.step_s;
    simulation_.set_physics(physics);
    runner_.follow_physics();
  }
  runner_.set_paused(settings.paused);
  set_start_pose(private_node, simulation_.world().source.file);
  add_spawn_services(servers_, context_);
  add_control_services(servers_, context_);
  add_model_state_services(servers_, context_);
  add_link_state_services(servers_, context_);
  add_property_services(servers_, context_);
  add_set_property_services(servers_, context_);
  add_physics_services(servers_, context_);
  add_force_services(servers_, context_);
  add_light_services(servers_, context_);
  ROS_INFO_STREAM("seed " << settings.seed << ", " << simulation_.entities().size()
                          << " models, step " << simulation_.physics().step_s << " s"
                          << (settings.paused ? ", paused" : ""));
}

namespace {

/// Whether a node of this name is registered; registering this node would end that one.
bool another_runs() {
  ros::V_string names;
  const std::string own = ros::this_node::getName();
  if (!ros::master::check() || !ros::master::getNodes(names)) return false;
  return std::find(names.begin(), names.end(), own) != names.end();
}

/// Reads the world without messages, and throws Error if it cannot be read.
void check_world(const CommandLine& command_line) {
  std::string world = command_line.world;
  if (world.empty()) ros::param::get("~world", world);
  bool lenient = false;
  ros::param::get("~lenient", lenient);
  Loader loader(make_locator(), Log([](LogLevel, const std::string&) {}),
                bad_parts(command_line.lenient.value_or(lenient)));
  if (!world.empty()) read_start_pose(load_world(loader, world).source.file);
}

void run_node(const CommandLine& command_line, const ros::NodeHandle& private_node) {
  if (command_line.verbose || private_node.param("verbose", false)) log_at_debug_level();
  const Settings settings = read_settings(command_line, private_node);
  if (settings.realtime_priority > 0) let_messages_go_first(settings.realtime_priority);
  SimulatorNode node(settings, private_node);
  use_simulated_time();
  node.run();
}

}  // namespace

int run_simulator(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // log lines appear as soon as they are written
  ros::init(argc, argv, kNodeName);
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  CommandLine command_line;
  try {
    command_line = parse_command_line(argc, argv);
  } catch (const Error& error) {
    std::cerr << "simulator: " << error.what() << "\n";
    return kBadInput;
  }
  if (command_line.help) {
    std::cout << usage();
    return 0;
  }
  try {
    if (another_runs()) check_world(command_line);
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return kBadInput;
  }
  const ros::NodeHandle private_node("~");  // outlives the message: logging needs a node
  try {
    run_node(command_line, private_node);
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return kBadInput;
  }
  return 0;
}

}  // namespace ardee::node
