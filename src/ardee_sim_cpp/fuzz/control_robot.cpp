// SPDX-License-Identifier: MIT
#include <tinyxml2.h>

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "ardee_sim/controllers/ros_control.h"
#include "ardee_sim/simulation/simulation.h"
#include "fuzz/inputs.h"
#include "fuzz/targets.h"

namespace ardee::fuzz {
namespace {

constexpr int kSteps = 5;
constexpr int kDeepest = 16;

/// Returns a robot with two wheels (velocities), two steered axles (positions) and two joints of an
/// arm (efforts) about the same axis.
std::string robot() {
  constexpr std::array<std::array<const char*, 3>, 6> kJoints{{{"left", "Velocity", "0 0.2 0"},
                                                               {"right", "Velocity", "0 -0.2 0"},
                                                               {"front", "Position", "0.3 0 0"},
                                                               {"rear", "Position", "-0.3 0 0"},
                                                               {"upper", "Effort", "0 0 0.2"},
                                                               {"lower", "Effort", "0 0 0.4"}}};
  const std::string body =
      "<inertial><mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' "
      "iyz='0'/></inertial><collision><geometry><sphere radius='0.1'/></geometry></collision>";
  std::string xml = "<robot name='r'><link name='base'>" + body + "</link>";
  for (const auto& [name, interface, place] : kJoints) {
    const std::string joint = name;
    xml +=
        "<link name='of_" + joint + "'>" + body + "</link><joint name='" + joint +
        "' type='revolute'><parent link='base'/><child link='of_" + joint +
        "'/><axis xyz='0 1 0'/><origin xyz='" + place +
        "'/><limit lower='-3' upper='3' effort='9' velocity='9'/></joint><transmission name='t_" +
        joint + "'><type>transmission_interface/SimpleTransmission</type><joint name='" + joint +
        "'><hardwareInterface>hardware_interface/" + interface +
        "JointInterface</hardwareInterface></joint><actuator name='a_" + joint +
        "'/></transmission>";
  }
  return xml + "<gazebo><plugin name='c' filename='libgazebo_ros_control.so'/></gazebo></robot>";
}

/// Converts XML to settings: <m> with a name for each child is a group, <l> a list; <d>, <i>, <b>,
/// <s> are a number, an integer, true or false, a text.
Setting to_setting(const tinyxml2::XMLElement& element, const std::string& path, int depth) {
  const std::string kind = element.Name();
  const char* const given = element.GetText();
  const std::string text = given ? given : "";
  if (kind == "d") return {path, std::strtod(text.c_str(), nullptr)};
  if (kind == "i") return {path, element.IntText()};
  if (kind == "b") return {path, element.BoolText()};
  if (kind != "m" && kind != "l") return {path, text};
  if (depth > kDeepest) throw Error("found a setting of more than 16 levels");
  Setting::Map map;
  Setting::List list;
  for (const auto* child = element.FirstChildElement(); child;
       child = child->NextSiblingElement()) {
    const char* const name = child->Attribute("name");
    const std::string key = name ? name : child->Name();
    const Setting setting = to_setting(*child, path + "/" + key, depth + 1);
    if (kind == "l") {
      list.push_back(setting);
    } else {
      map[key] = setting;
    }
  }
  return kind == "l" ? Setting(path, std::move(list)) : Setting(path, std::move(map));
}

/// Goal without a client that waits for its result.
template <typename Action>
class Forgotten : public Action::Handle {
 public:
  void accept() override {}
  void reject(const typename Action::Result&, const std::string&) override {}
  void feed_back(const typename Action::Feedback&) override {}
  void succeed(const typename Action::Result&) override {}
  void abort(const typename Action::Result&) override {}
  void cancel() override {}
};

devices::JointTrajectory some_trajectory() {
  devices::JointTrajectory trajectory;
  trajectory.joints = {"upper", "lower"};
  trajectory.points = {{{0.5, -0.5}, {}, {}, {}, 0.03}, {{1.0, 0.0}, {0.0, 0.0}, {}, {}, 0.07}};
  return trajectory;
}

void set_goal(const devices::FollowTrajectoryAction& action) {
  const auto goal = std::make_shared<Forgotten<devices::FollowTrajectoryAction>>();
  devices::FollowTrajectoryGoal wanted;
  wanted.trajectory = some_trajectory();
  action.on_goal(wanted, goal);
}

void set_goal(const devices::GripperAction& action) {
  action.on_goal({0.5, 3.0}, std::make_shared<Forgotten<devices::GripperAction>>());
}

/// Sends a command; one that a controller refuses changes nothing.
void command(devices::Ports& ports) {
  const std::vector<devices::Command> commands{devices::Trigger{},
                                               Twist{{0.5, 0.1, 0.0}, {0.0, 0.0, 0.3}},
                                               0.7,
                                               true,
                                               std::vector<double>{0.3, -0.2},
                                               devices::SteeringCommand{0.2, -0.1, 0.5},
                                               some_trajectory()};
  for (const devices::Input& input : ports.all<devices::Input>()) {
    for (const devices::Command& each : commands) {
      if (each.index() != input.kind) continue;
      try {
        input.on_command(each);
      } catch (const Error&) {
      }
    }
  }
  for (const devices::Action& action : ports.all<devices::Action>()) {
    std::visit([](const auto& each) { set_goal(each); }, action);
  }
  for (const devices::ParameterGroup& tuning : ports.all<devices::ParameterGroup>()) {
    for (const devices::TunableParameter& tunable : tuning.parameters) tunable.set(tunable.high);
  }
}

void run(Simulation& simulation) {
  for (int i = 0; i < kSteps; ++i) simulation.step();
  const devices::Robot& robot = *simulation.entities().back()->robot;
  for (std::size_t link = 0; link < robot.model().links.size(); ++link) {
    if (!robot.link_pose(link).is_finite()) throw std::logic_error("a link is nowhere");
  }
}

}  // namespace

void control_robot(const std::string& input) {
  tinyxml2::XMLDocument document;
  if (document.Parse(input.data(), input.size()) != tinyxml2::XML_SUCCESS ||
      !document.RootElement()) {
    throw Error("found no XML");
  }
  const Setting settings = to_setting(*document.RootElement(), "/c", 0);
  SimulationOptions options;
  options.parameter = [&settings](const std::string& name) {
    return name == "/c" ? settings : Setting(name, settings.at(name.substr(1)).value());
  };
  Loader loader = make_loader();
  const World world = loader.load_world_text(
      "<sdf version='1.6'><world name='plain'><physics type='ode'><max_step_size>0.02"
      "</max_step_size></physics></world></sdf>",
      "plain.world");
  Simulation simulation(world, options, [](LogLevel, const std::string&) {});
  SpawnRequest request;
  request.name = "r";
  request.model = loader.load_model_text(robot(), "r.urdf");
  const Entity& entity = simulation.spawn(request);
  auto* device = entity.devices.empty()
                     ? nullptr
                     : dynamic_cast<control::RosControl*>(entity.devices.front().get());
  if (!device) throw Error("found settings of joints that leave ros_control out");
  control::Manager& manager = device->manager();
  devices::Ports& ports = manager.load("c").ports();
  manager.switch_controllers({{"c"}, {}, control::Strictness::kStrict});
  try {
    run(simulation);
    command(ports);
    run(simulation);
    simulation.reset_simulation();
    run(simulation);
    manager.switch_controllers({{}, {"c"}, control::Strictness::kStrict});
    run(simulation);
    manager.unload("c");
    run(simulation);
  } catch (const Error& error) {
    throw std::logic_error(std::string("refused when it ran already: ") + error.what());
  }
}

}  // namespace ardee::fuzz
