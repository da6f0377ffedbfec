// SPDX-License-Identifier: MIT
// Prints what a physics step costs for a robot on a heightmap among 200 and 200,000 plants.
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "rover.h"

namespace {

using ardee::PhysicsParams;
using ardee::PhysicsWorld;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Rows 0.76 m apart, plants 0.15 m apart in the row, around the origin; the robot drives between two rows.
std::vector<ardee::Placement> plants(int count) {
  const auto stalk = ardee::test::static_model(ardee::Cylinder{0.012, 1.8});
  const int rows = std::max(2, static_cast<int>(std::sqrt(count * 0.15 / 0.76)));
  const int columns = count / rows;
  std::vector<ardee::Placement> result;
  for (int i = 0; i < rows * columns; ++i) {
    const double x = 0.15 * (i % columns - columns / 2);
    const double y = 0.76 * (i / columns - rows / 2 + 0.5);
    result.push_back(ardee::test::placement(stalk, ardee::test::at(x, y, 0.9), 0.9 + 0.001 * (i % 200)));
  }
  return result;
}

void measure(int count, double step_s, PhysicsParams::Solver solver) {
  PhysicsParams params = ardee::test::params(step_s);
  params.solver = solver;
  PhysicsWorld world(params, ardee::test::silent());
  world.reset_random(0);
  const auto bumps = [](double x, double y) { return 0.02 * std::sin(3.0 * x) * std::cos(2.0 * y); };
  world.add_scenery({ardee::test::placement(
      ardee::test::static_model(ardee::test::heightmap(ardee::test::height_grid(257, 26.0, bumps))))});
  const auto placements = plants(count);
  auto start = Clock::now();
  world.add_scenery(placements);
  const double add_s = seconds_since(start);
  const ardee::test::RoverShape shape;
  auto& rover = world.add_model(ardee::test::rover_model(shape), ardee::test::at(-2, 0, 0.15));
  ardee::test::run(world, 1.0);
  ardee::test::drive(rover, shape, 5.0, 5.0);
  const int steps = static_cast<int>(8.0 / step_s);
  start = Clock::now();
  std::size_t contacts = 0, tested = 0;
  for (int i = 0; i < steps; ++i) {
    world.step();
    contacts += world.stats().contacts;
    tested += world.stats().scenery_tested;
  }
  const double step_us = seconds_since(start) / steps * 1e6;
  std::printf("%7d plants, step %.0f ms, %s: %6.1f us a step, %.1f contacts, %.1f bounds tested, "
              "scenery added in %.3f s, robot at %.2f %.2f %.3f\n",
              count, 1e3 * step_s, solver == PhysicsParams::Solver::kQuick ? "quick" : "world",
              step_us, static_cast<double>(contacts) / steps, static_cast<double>(tested) / steps, add_s,
              rover.pose().p.x(), rover.pose().p.y(), rover.pose().p.z());
}

}  // namespace

int main() {
  for (const auto solver : {PhysicsParams::Solver::kQuick, PhysicsParams::Solver::kWorld}) {
    for (const double step_s : {0.001, 0.005}) {
      for (const int count : {200, 200000}) measure(count, step_s, solver);
    }
  }
  return EXIT_SUCCESS;
}
