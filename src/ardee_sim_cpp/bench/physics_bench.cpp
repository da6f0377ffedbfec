// SPDX-License-Identifier: MIT
// Prints, as JSON, what a physics step costs for a robot on a heightmap among few and among many
// plants.
#include <cmath>
#include <cstdio>

#include "rover.h"
#include "stopwatch.h"

namespace ardee::bench {
namespace {

/// Rows 0.76 m apart, plants 0.15 m apart in the row, around the origin; the robot drives between
/// two rows.
std::vector<Placement> plants(int count) {
  const auto stalk = test::static_model(Cylinder{0.012, 1.8});
  const int rows = std::max(2, static_cast<int>(std::sqrt(count * 0.15 / 0.76)));
  const int columns = count / rows;
  std::vector<Placement> result;
  for (int i = 0; i < rows * columns; ++i) {
    const double x = 0.15 * (i % columns - columns / 2);
    const double y = 0.76 * (i / columns - rows / 2 + 0.5);
    result.push_back(test::placement(stalk, test::at(x, y, 0.9), 0.9 + 0.001 * (i % 200)));
  }
  return result;
}

struct Figures {
  double add_s = 0.0;
  double memory_mb = 0.0;  // that the scenery took
  double step_us = 0.0;
  double direct = 0.0;
  double contacts = 0.0;
  double tested = 0.0;
};

Figures measure(int count, double step_s) {
  Figures figures;
  PhysicsWorld world(test::params(step_s), test::silent());
  world.reset_random(0);
  const auto bumps = [](double x, double y) {
    return 0.02 * std::sin(3.0 * x) * std::cos(2.0 * y);
  };
  world.add_scenery(
      {test::placement(test::static_model(test::heightmap(test::height_grid(257, 26.0, bumps))))});
  const auto placements = plants(count);
  const double before_mb = memory_mb("VmRSS");
  Stopwatch stopwatch;
  world.add_scenery(placements);
  figures.add_s = stopwatch.elapsed_s();
  figures.memory_mb = memory_mb("VmRSS") - before_mb;

  const test::RoverShape shape;
  PhysicsModel& rover = world.add_model(test::rover_model(shape), test::at(-2, 0, 0.15));
  test::run(world, 1.0);
  test::drive(rover, shape, 5.0, 5.0);
  const int steps = test::steps(world, 8.0);
  CpuStopwatch processor;
  for (int i = 0; i < steps; ++i) {
    world.step();
    const PhysicsWorld::Stats stats = world.stats();
    figures.direct += stats.solved_directly ? 1.0 / steps : 0.0;
    figures.contacts += static_cast<double>(stats.contacts) / steps;
    figures.tested += static_cast<double>(stats.scenery_tested) / steps;
  }
  figures.step_us = processor.elapsed_s() / steps * 1e6;
  return figures;
}

}  // namespace
}  // namespace ardee::bench

int main() {
  const char* separator = "[\n";
  for (const double step_s : {0.001, 0.005}) {
    for (const int count : {200, 2000, 20000, 200000}) {
      const ardee::bench::Figures figures = ardee::bench::measure(count, step_s);
      std::printf(
          "%s  {\"plants\": %d, \"step_s\": %g, \"step_us\": %.1f, \"solved_directly\": %.3f, "
          "\"contacts\": %.1f, \"bounds_tested\": %.1f, \"add_s\": %.3f, \"memory_mb\": %.1f}",
          separator, count, step_s, figures.step_us, figures.direct, figures.contacts,
          figures.tested, figures.add_s, figures.memory_mb);
      separator = ",\n";
    }
  }
  std::puts("\n]");
  return 0;
}
