// SPDX-License-Identifier: MIT
// Drives a robot straight on for ten seconds and prints its lidar's ranges: minimal WORLD ROBOT
#include <algorithm>
#include <iostream>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"

int main(int argc, char** argv) try {
  if (argc != 3) throw ardee::Error("usage: minimal WORLD ROBOT");
  ardee::Loader loader(ardee::ResourceLocator::from_environment(), ardee::Log());
  ardee::Simulation sim(loader.load_world(argv[1]), {}, nullptr);
  sim.spawn({"robot", loader.load_model(argv[2]), {{0, 0, 0.175}}});

  const auto drive = sim.command_port<ardee::Twist>("cmd_vel");
  const auto lidar = sim.reading_port<ardee::devices::LidarReading>("ardee/hokuyo");
  for (int second = 1; second <= 10; ++second) {
    while (sim.now_ns() < second * 1'000'000'000LL) {
      sim.command(drive, {{0.5, 0, 0}, {0, 0, 0}});
      sim.step();
    }
    const auto& ranges_m = sim.latest(lidar)->ranges_m;
    std::cout << second << " s: x = " << sim.find("robot")->robot->pose().p.x() << " m, nearest "
              << *std::min_element(ranges_m.begin(), ranges_m.end()) << " m\n";
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << "minimal: " << error.what() << "\n";
  return 1;
}
