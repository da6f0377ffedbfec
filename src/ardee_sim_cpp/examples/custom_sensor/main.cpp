// SPDX-License-Identifier: MIT
// Drops a box onto a slope, where it slides; its inclinometer measures the slope.
#include <iostream>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/plugins.h"
#include "ardee_sim/simulation/simulation.h"
#include "inclinometer.h"

constexpr const char* kWorld = R"(
<sdf version="1.6"><world name="slope">
  <model name="slope"><static>true</static><pose>0 0 0 0 0.2 0</pose><link name="link">
    <collision name="c"><geometry><box><size>20 20 0.02</size></box></geometry></collision>
  </link></model>
</world></sdf>)";

constexpr const char* kRobot = R"(
<robot name="box"><link name="base"><inertial><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  <collision><geometry><box size="0.4 0.4 0.1"/></geometry></collision></link>
  <gazebo><plugin name="inclinometer" filename="libinclinometer.so">
    <topicName>inclination</topicName><updateRate>20</updateRate><gaussianNoise>0.001</gaussianNoise>
  </plugin></gazebo></robot>)";

int main() try {
  auto plugins = std::make_shared<ardee::devices::Registry>(ardee::known_plugins());
  plugins->add_model_sensor("inclinometer", &Inclinometer::make);
  ardee::SimulationOptions options;
  options.registry = plugins;

  ardee::Loader loader(ardee::ResourceLocator::from_environment(), ardee::Log());
  ardee::Simulation sim(loader.load_world_text(kWorld, "slope.world"), options, nullptr);
  sim.spawn({"box", loader.load_model_text(kRobot, "box.urdf"), {{0, 0, 0.3}}});
  const auto inclination = sim.reading_port<ardee::devices::VectorReading>("inclination");
  while (sim.now_ns() < 2'000'000'000) sim.step();
  const Eigen::Vector3d& angles_rad = sim.latest(inclination)->vector;
  std::cout << "roll " << angles_rad.x() << " rad, pitch " << angles_rad.y() << " rad\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << "custom_sensor: " << error.what() << "\n";
  return 1;
}
