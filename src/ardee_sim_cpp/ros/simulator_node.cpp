// SPDX-License-Identifier: MIT
#include "ros/simulator_node.h"

#include <ros/network.h>
#include <ros/package.h>
#include <ros/ros.h>
#include <sched.h>
#include <unistd.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>
#include <thread>

#include "ardee_sim/readers/start_pose.h"
#include "ros/log_to_ros.h"
#include "ros/setting_from_ros.h"

namespace ardee::node {
namespace {

constexpr char kNodeName[] = "gazebo";  // users' code calls its private services by this name
constexpr int kBadInput = 2;
constexpr auto kMasterPoll = std::chrono::milliseconds(200);

std::optional<std::string> find_package(const std::string& package) {
  const std::string path = ros::package::getPath(package);
  return path.empty() ? std::nullopt : std::optional<std::string>(path);
}

ResourceLocator make_locator(const std::vector<std::string>& model_paths) {
  ResourceLocator locator = ResourceLocator::from_environment();
  locator.add_first_model_paths(model_paths);
  locator.set_package_finder(find_package);
  return locator;
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
      loader_(make_locator(settings.model_paths), Log(messages_.sink()),
              bad_parts(settings.lenient)),
      simulation_(loader_.load_world(make_locator(settings.model_paths).find_world(settings.world)),
                  simulation_options(settings), messages_.sink()),
      frames_(settings.publish_world_tf),
      metrics_(private_node),
      topics_(frames_, metrics_, Log(messages_.sink())),
      states_(private_node, simulation_),
      clock_(settings.clock_rate_hz),
      scenery_(simulation_, settings.scenery_radius_m, settings.show_collisions),
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
void check_world(const CommandLine& command_line, const std::string& world, bool lenient) {
  if (world.empty()) return;
  const ResourceLocator locator = make_locator(command_line.model_paths);
  Loader loader(locator, Log([](LogLevel, const std::string&) {}),
                bad_parts(command_line.lenient.value_or(lenient)));
  read_start_pose(loader.load_world(locator.find_world(world)).source.file);
}

/// Checks the world of a node that is going to take the place of another one.
void check_world_of_parameters(const CommandLine& command_line) {
  std::string world = command_line.world;
  if (world.empty()) ros::param::get("~world", world);
  bool lenient = false;
  ros::param::get("~lenient", lenient);
  check_world(command_line, world, lenient);
}

/// The value of an argument of ROS's, as _world:=VALUE or __master:=VALUE, before ros::init.
std::string ros_argument(int argc, char** argv, const std::string& name, std::string fallback) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind(name + ":=", 0) == 0) fallback = word.substr(name.size() + 2);
  }
  return fallback;
}

bool has_master(const std::string& host, std::uint32_t port) {
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue arguments;
  XmlRpc::XmlRpcValue answer;
  arguments[0] = kNodeName;
  return client.execute("getPid", arguments, answer) && !client.isFault();
}

/// Waits until there is a ROS master, for ros::init does so without a word. A broken world is
/// refused before.
void wait_for_master(int argc, char** argv, const CommandLine& command_line) {
  const char* given = std::getenv("ROS_MASTER_URI");
  const std::string uri = ros_argument(argc, argv, "__master", given ? given : "");
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port) || has_master(host, port)) return;
  const std::string world =
      command_line.world.empty() ? ros_argument(argc, argv, "_world", "") : command_line.world;
  check_world(command_line, world, ros_argument(argc, argv, "_lenient", "false") == "true");
  std::cerr << "simulator: waiting for the ROS master at " << uri << " (start one: roscore)\n";
  while (!has_master(host, port)) std::this_thread::sleep_for(kMasterPoll);
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
  CommandLine command_line;
  try {
    command_line = parse_command_line(argc, argv);
    if (command_line.help) {
      std::cout << usage();
      return 0;
    }
    wait_for_master(argc, argv, command_line);
  } catch (const std::exception& error) {
    std::cerr << "simulator: " << error.what() << "\n";
    return kBadInput;
  }
  ros::init(argc, argv, kNodeName);
  std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
  try {
    if (another_runs()) check_world_of_parameters(command_line);
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
