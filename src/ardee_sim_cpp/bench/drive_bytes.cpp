// SPDX-License-Identifier: MIT
// Compares builds of the simulator: prints a hash of each topic's readings on a drive, for all
// devices of a robot.
#include <iomanip>
#include <iostream>

#include "ardee_sim/core/rng.h"
#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "bench/bench_arguments.h"
#include "bench/lane_keeper.h"
#include "test/simulation/reading_bytes.h"

namespace ardee::bench {
namespace {

constexpr const char* kUsage =
    "usage: drive_bytes --world FILE --robot FILE [--pose 'X Y Z YAW'] [--lane-m 6]\n"
    "         [--speed-m-s 0.5] [--duration-s 10] [--seed 0] [--threads 0]\n"
    "Prints a line a topic: hash, bytes, topic.\n";

void run(const BenchArguments& arguments) {
  Loader loader(ResourceLocator::from_environment(), Log());
  SimulationOptions options;
  options.seed = static_cast<std::uint64_t>(arguments.number("--seed"));
  options.rays.threads = static_cast<int>(arguments.number("--threads"));
  Simulation simulation(loader.load_world(arguments.text("--world")), options, nullptr);
  BytesByTopic bytes;
  simulation.set_sink(&bytes);
  SpawnRequest request;
  request.name = "robot";
  request.model = loader.load_model(arguments.text("--robot"));
  request.X_WM = arguments.pose("--pose");
  Entity& robot = simulation.spawn(request);
  LaneKeeper keeper(arguments.pose("--pose"), arguments.number("--lane-m"),
                    arguments.number("--speed-m-s"));
  const TimeNs end = nanoseconds(arguments.number("--duration-s"));
  while (simulation.now_ns() < end) {
    for (const auto& device : robot.devices) {
      for (const devices::Input& input : device->ports().all<devices::Input>()) {
        if (input.kind != devices::command_kind<Twist>()) continue;
        input.on_command(keeper.command(robot.robot->pose()));
      }
    }
    simulation.step();
  }
  for (const auto& [topic, said] : bytes.take()) {
    std::cout << std::hex << std::setw(16) << std::setfill('0') << stream_key(0, said) << std::dec
              << " " << said.size() << " " << topic << "\n";
  }
}

}  // namespace
}  // namespace ardee::bench

int main(int argc, char** argv) {
  return ardee::bench::run_bench(argc, argv,
                                 {{"--duration-s", "10"}, {"--seed", "0"}, {"--threads", "0"}},
                                 ardee::bench::kUsage, ardee::bench::run);
}
