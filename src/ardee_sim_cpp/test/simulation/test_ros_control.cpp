// SPDX-License-Identifier: MIT
// Tests of libgazebo_ros_control.so on a flywheel of 1 kg m^2 and on two wheels, in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "ardee_sim/controllers/ros_control.h"
#include "motion_rig.h"

namespace ardee {
using namespace devices;
namespace {

constexpr double kStep_s = 0.001;
using Parameters = std::map<std::string, Setting>;

Setting text(const std::string& value) { return {"", value}; }
Setting number(double value) { return {"", value}; }

/// Returns a group with the paths of a parameter server's.
Setting group(const std::string& path, Setting::Map map) {
  for (auto& [key, value] : map) value = Setting(path + "/" + key, value.value());
  return {path, std::move(map)};
}

Setting forward(const std::string& name, const std::string& type) {
  return group("/" + name, {{"type", text(type)}, {"joint", text("axle")}});
}

std::string transmission(const std::string& joint, const std::string& interface) {
  return "<transmission name='of_" + joint + "'><type>T</type><joint name='" + joint +
         "'><hardwareInterface>" + interface +
         "</hardwareInterface></joint><actuator name='m'/></transmission>";
}

std::string control(const std::string& keys = "") {
  return "<gazebo>" + plugin("gazebo_ros_control", keys, "control") + "</gazebo>";
}

/// Returns a flywheel about z on a post in the world.
std::string flywheel(const std::string& interface, const std::string& keys = "",
                     const std::string& type = "continuous",
                     const std::string& in_joint = "<limit effort='2' velocity='50'/>") {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial>";
  return "<robot name='flywheel'><link name='world'/><link name='post'>" + inertial +
         "</link><link name='wheel'>" + inertial +
         "</link><joint name='foot' type='fixed'><parent link='world'/><child link='post'/></joint>"
         "<joint name='axle' type='" +
         type + "'><parent link='post'/><child link='wheel'/><axis xyz='0 0 1'/>" + in_joint +
         "</joint>" + transmission("axle", "hardware_interface/" + interface) + control(keys) +
         "</robot>";
}

class RosControlTest : public ::testing::Test {
 protected:
  Entity& spawn(const std::string& xml, double gravity_m_per_s2 = 0.0) {
    SimulationOptions options;
    options.parameter = [this](const std::string& name) {
      const auto found = parameters_.find(name);
      return found == parameters_.end() ? no_parameter(name) : found->second;
    };
    world_.emplace(free_space(gravity_m_per_s2), kStep_s, options);
    robot_ = &world_->spawn(xml, "robot");
    return *robot_;
  }
  control::RosControl& device() {
    return dynamic_cast<control::RosControl&>(*robot_->devices.at(0));
  }
  control::Controller& start(const std::string& name) {
    control::Controller& controller = device().manager().load(name);
    device().manager().switch_controllers({{name}, {}});
    return controller;
  }
  void command(control::Controller& controller, const Command& command) {
    controller.ports().all<Input>().at(0).get().on_command(command);
  }
  double position() const { return robot_->robot->dynamics().joint_position(1); }
  double velocity() const { return robot_->robot->dynamics().joint_velocity(1); }
  bool said(const std::string& part) const {
    for (const std::string& each : world_->messages()) {
      if (each.find(part) != std::string::npos) return true;
    }
    return false;
  }

  Parameters parameters_{
      {"/effort", forward("effort", "effort_controllers/JointEffortController")},
      {"/velocity", forward("velocity", "velocity_controllers/JointVelocityController")},
      {"/position", forward("position", "position_controllers/JointPositionController")}};
  std::optional<TestWorld> world_;
  Entity* robot_ = nullptr;
};

TEST_F(RosControlTest, AnEffortAccelerates) {
  spawn(flywheel("EffortJointInterface"));
  control::Controller& effort = start("effort");
  world_->run(kStep_s);  // the first period begins
  command(effort, 1.5);
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 1.5, 1e-9);
  command(effort, 9.0);  // the limit is 2 N m
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 3.5, 1e-9);
}

TEST_F(RosControlTest, AVelocityIsReachedWithTheEffortLimitAndHeld) {
  spawn(flywheel("VelocityJointInterface"));
  control::Controller& velocities = start("velocity");
  world_->run(kStep_s);
  command(velocities, 3.0);
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 2.0, 1e-9);
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 3.0, 1e-9);
}

TEST_F(RosControlTest, WithoutAControllerAVelocityJointIsHeldAndAnEffortJointIsFree) {
  for (const std::string interface : {"VelocityJointInterface", "EffortJointInterface"}) {
    spawn(flywheel(interface));
    (*world_)->joint_efforts().add({robot_->robot.get(), 1, 1.0, 0, nanoseconds(1.0)});
    world_->run(2.0);
    EXPECT_NEAR(velocity(), interface[0] == 'V' ? 0.0 : 1.0, 1e-6) << interface;
  }
}

TEST_F(RosControlTest, APositionIsThereAtTheVelocityLimit) {
  spawn(flywheel("PositionJointInterface"));
  control::Controller& positions = start("position");
  world_->run(kStep_s);
  command(positions, 1.0);
  world_->run(0.01);
  EXPECT_NEAR(position(), 0.5, 1e-9);  // 50 rad/s
  world_->run(0.02);
  EXPECT_NEAR(position(), 1.0, 1e-9);
  EXPECT_NEAR(velocity(), 0.0, 1e-9);
}

TEST_F(RosControlTest, GainsMakeAnEffortOfAPosition) {
  parameters_["/gazebo_ros_control/pid_gains/axle"] =
      group("/gazebo_ros_control/pid_gains/axle", {{"p", number(4.0)}, {"d", number(4.0)}});
  spawn(flywheel("PositionJointInterface"));
  control::Controller& positions = start("position");
  world_->run(kStep_s);
  command(positions, 0.25);
  world_->run(0.5);
  // The equation x'' = 4 (r - x) - 4 x' from rest gives x = r (1 - (1 + 2 t) exp(-2 t)); 50 rad/s
  // let the command jump within 5 ms, and the effort limit removes the derivative's kick at the
  // jump.
  EXPECT_NEAR(position(), 0.25 * (1.0 - 2.0 * std::exp(-1.0)), 0.01);
  world_->run(5.0);
  EXPECT_NEAR(position(), 0.25, 1e-3);
  EXPECT_EQ(device().ports().all<ParameterGroup>().at(0).get().name,
            "/gazebo_ros_control/pid_gains/axle");
}

TEST_F(RosControlTest, GainsMakeAnEffortOfAVelocityWithinTheLimit) {
  parameters_["/gazebo_ros_control/pid_gains/axle"] =
      group("/gazebo_ros_control/pid_gains/axle", {{"p", number(1.0)}});
  spawn(flywheel("VelocityJointInterface"));
  control::Controller& velocities = start("velocity");
  world_->run(kStep_s);
  command(velocities, 10.0);
  world_->run(1.0);  // the command is 10 N m, the limit 2
  EXPECT_NEAR(velocity(), 2.0, 1e-3);
  command(velocities, 3.0);
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 3.0 - std::exp(-1.0), 2e-3);
}

TEST_F(RosControlTest, AbsoluteGainsCountInLegacyModeOnly) {
  parameters_["/gazebo_ros_control/pid_gains/axle"] =
      group("/gazebo_ros_control/pid_gains/axle", {{"p", number(1.0)}});
  const std::string space = "<robotNamespace>far</robotNamespace>";
  spawn(flywheel("VelocityJointInterface", space));
  EXPECT_TRUE(device().ports().all<ParameterGroup>().empty());
  EXPECT_TRUE(said("joint 'axle': no gains at /far/gazebo_ros_control/pid_gains/axle"));
  spawn(flywheel("VelocityJointInterface", space + "<legacyModeNS>true</legacyModeNS>"));
  EXPECT_EQ(device().ports().all<ParameterGroup>().size(), 1u);
}

TEST_F(RosControlTest, AnEmergencyStopBrakesAndLetsGo) {
  spawn(flywheel("VelocityJointInterface", "<eStopTopic>stop</eStopTopic>"));
  control::Controller& velocities = start("velocity");
  world_->run(kStep_s);
  command(velocities, 1.0);
  world_->run(1.0);
  const Input& stop = device().ports().all<Input>().at(0);
  EXPECT_EQ(stop.topic, "/stop");
  stop.on_command(true);
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 0.0, 1e-9);
  stop.on_command(false);
  world_->run(1.0);  // controllers start again: the command is 0
  EXPECT_NEAR(velocity(), 0.0, 1e-9);
  command(velocities, 1.0);
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 1.0, 1e-9);
}

TEST_F(RosControlTest, ControllersActEachControlPeriod) {
  parameters_["/states"] =
      group("/states", {{"type", text("joint_state_controller/JointStateController")},
                        {"publish_rate", number(1e4)}});
  for (const auto& [keys, count] :
       std::map<std::string, std::size_t>{{"", 100}, {"<controlPeriod>0.01</controlPeriod>", 10}}) {
    spawn(flywheel("EffortJointInterface", keys));
    start("states");
    world_->run(0.1 + kStep_s);
    EXPECT_EQ(world_->recorder().count("/joint_states"), count) << keys;
    EXPECT_EQ(said("less often than the physics"), !keys.empty());
  }
}

TEST_F(RosControlTest, AResetRestartsWhatRuns) {
  spawn(flywheel("VelocityJointInterface"));
  control::Controller& velocities = start("velocity");
  const auto run = [&] {
    world_->run(kStep_s);
    command(velocities, 1.0);
    world_->run(0.2);
    const double reached = position();
    (*world_)->reset_simulation();
    return reached;
  };
  const double first = run();
  EXPECT_NEAR(first, 0.04, 0.0005);  // 2 rad/s^2 for 0.2 s
  EXPECT_EQ(run(), first);
  EXPECT_TRUE(velocities.is_running());
  world_->run(0.5);
  EXPECT_NEAR(velocity(), 0.0, 1e-12);  // the command is dropped
}

TEST_F(RosControlTest, LimitsOfParametersCount) {
  parameters_["/joint_limits/axle"] =
      group("/joint_limits/axle", {{"has_effort_limits", {"", true}}, {"max_effort", number(0.5)}});
  spawn(flywheel("VelocityJointInterface"));
  control::Controller& velocities = start("velocity");
  world_->run(kStep_s);
  command(velocities, 9.0);
  world_->run(1.0);
  EXPECT_NEAR(velocity(), 0.5, 1e-9);
}

TEST_F(RosControlTest, SensorControllersSayWhatTheWheelFeels) {
  parameters_["/imus"] =
      group("/imus", {{"type", text("imu_sensor_controller/ImuSensorController")},
                      {"publish_rate", number(100.0)}});
  parameters_["/wrenches"] = group(
      "/wrenches", {{"type", text("force_torque_sensor_controller/ForceTorqueSensorController")},
                    {"publish_rate", number(100.0)}});
  std::string xml = flywheel("VelocityJointInterface");
  xml.insert(xml.find("<transmission"),
             "<gazebo reference='wheel'><sensor name='wheel_imu' type='imu'/></gazebo>");
  spawn(xml, -9.8);
  start("imus");
  start("wrenches");
  control::Controller& velocities = start("velocity");
  world_->run(kStep_s);
  command(velocities, 2.0);
  world_->run(3.0);
  const auto imu = world_->recorder().on<ImuReading>("/wheel_imu").back();
  EXPECT_EQ(imu.header.frame_id, "wheel");
  EXPECT_NEAR(imu.linear_acceleration.z(), 9.8, 1e-6);
  EXPECT_NEAR(imu.angular_velocity.z(), 2.0, 1e-6);
  const double since_s = seconds((*world_)->now_ns() - imu.header.stamp_ns);
  const double yaw = 2.0 * std::atan2(imu.orientation.z(), imu.orientation.w());
  EXPECT_NEAR(std::remainder(yaw + 2.0 * since_s - position(), 2.0 * 3.14159265358979), 0.0,
              2.0 * kStep_s);
  const auto axle = world_->recorder().on<WrenchReading>("/axle").back();  // carries 1 kg
  EXPECT_EQ(axle.header.frame_id, "wheel");
  EXPECT_NEAR(axle.wrench.force.z(), -9.8, 1e-6);
  EXPECT_NEAR(axle.wrench.torque.norm(), 0.0, 1e-6);
}

TEST_F(RosControlTest, AnUnknownInterfaceLeavesTheRobotWithoutManager) {
  spawn(flywheel("ImuSensorInterface"));
  EXPECT_TRUE(robot_->devices.empty());
  EXPECT_TRUE(
      said("transmission 'of_axle': found hardwareInterface "
           "'hardware_interface/ImuSensorInterface', expected "
           "hardware_interface/EffortJointInterface, PositionJointInterface or "
           "VelocityJointInterface; there is no controller_manager for the robot 'robot'"));
}

TEST_F(RosControlTest, SaysWhatIsNotAsTheOriginalNeedsIt) {
  std::string xml = flywheel("EffortJointInterface");
  xml.insert(xml.find("<transmission"), transmission("knee", "EffortJointInterface"));
  spawn(xml);
  EXPECT_TRUE(robot_->devices.empty());
  EXPECT_TRUE(said("'knee'"));
  spawn(flywheel("EffortJointInterface", "<robotSimType>steer_bot/Hardware</robotSimType>"));
  EXPECT_EQ(robot_->devices.size(), 1u);
  EXPECT_TRUE(said(
      "found 'steer_bot/Hardware', expected steer_bot_hardware_gazebo/SteerBotHardwareGazebo or "
      "gazebo_ros_control/DefaultRobotHWSim, which is taken in its place"));
  spawn(flywheel("EffortJointInterface", "", "fixed"));
  EXPECT_TRUE(said("found joint 'axle', which is held"));
  EXPECT_TRUE(said("nothing is controlled"));
}

}  // namespace
}  // namespace ardee
