// SPDX-License-Identifier: MIT
// Times the engine in a field whose plants are models that can move: boxes at rest in rows on a
// plane, and a robot that drives to and fro between two of them.
#include <iostream>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "bench/bench_arguments.h"
#include "bench/lane_keeper.h"
#include "bench/stopwatch.h"

namespace ardee::bench {
namespace {

constexpr const char* kUsage =
    "usage: free_models_bench --robot FILE [--plant FILE] [--plants 880] [--pose 'X Y Z YAW'] "
    "[--lane-m 6]\n"
    "         [--speed-m-s 0.5] [--settle-s 2] [--duration-s 10]\n"
    "Prints JSON: real-time factors while the plants come to rest, and of the drive after that.\n";

std::shared_ptr<const Model> plane() {
  auto model = std::make_shared<Model>();
  model->name = "ground";
  model->is_static = true;
  Link link;
  link.name = "link";
  link.collisions.emplace_back();
  link.collisions.back().geometry = Plane{};
  model->links.push_back(link);
  model->canonical_link = "link";
  return model;
}

/// Returns a stalk of 0.2 kg on a foot.
std::shared_ptr<const Model> plant() {
  auto model = std::make_shared<Model>();
  model->name = "plant";
  Link link;
  link.name = "link";
  link.inertial.emplace();
  link.inertial->mass_kg = 0.2;
  link.inertial->inertia_kg_m2 = 0.001 * Eigen::Matrix3d::Identity();
  link.inertial->X_LI.p = {0, 0, 0.05};
  link.collisions.resize(2);
  link.collisions[0].geometry = Box{{0.1, 0.1, 0.04}};
  link.collisions[0].X_LC.p = {0, 0, 0.02};
  link.collisions[1].geometry = Cylinder{0.01, 0.4};
  link.collisions[1].X_LC.p = {0, 0, 0.22};
  for (const Collision& collision : link.collisions) {
    Visual visual;
    visual.geometry = collision.geometry;
    visual.X_LV = collision.X_LC;
    link.visuals.push_back(visual);
  }
  model->links.push_back(link);
  model->canonical_link = "link";
  return model;
}

/// Returns a field with rows 0.75 m apart along x, plants 0.2 m apart, and the origin between two
/// rows.
World field(int plants, const std::shared_ptr<const Model>& model) {
  constexpr int kRows = 20;
  World world;
  world.models.push_back({plane(), "ground", Pose{}});
  for (int i = 0; i < plants; ++i) {
    const double x = 0.2 * static_cast<double>(i / kRows);
    const double y = 0.75 * (static_cast<double>(i % kRows - kRows / 2) + 0.5);
    const Pose X_WM{{x, y, 0.01}, Eigen::Quaterniond::Identity()};
    world.models.push_back({model, "plant_" + std::to_string(i), X_WM});
  }
  return world;
}

/// Makes the robot measure all that it can.
class Listener : public devices::ReadingSink {
  void on_reading(const devices::Output&, const devices::Reading&) override {}
};

void run(const BenchArguments& arguments) {
  Loader loader(ResourceLocator::from_environment(), Log());
  const std::string file = arguments.text("--plant");
  const auto model = file.empty() ? plant() : loader.load_model(file);
  Simulation simulation(field(static_cast<int>(arguments.number("--plants")), model), {}, nullptr);
  Listener listener;
  simulation.set_sink(&listener);
  SpawnRequest request;
  request.name = "robot";
  request.model = loader.load_model(arguments.text("--robot"));
  request.X_WM = arguments.pose("--pose");
  const Entity& robot = simulation.spawn(request);
  LaneKeeper keeper(request.X_WM, arguments.number("--lane-m"), arguments.number("--speed-m-s"));
  double distance_m = 0.0;
  const auto drive = [&](double duration_s) {
    const TimeNs end = simulation.now_ns() + nanoseconds(duration_s);
    RateTimer command_due(20.0);
    command_due.start_at(simulation.now_ns());
    const Stopwatch wall;
    Eigen::Vector3d last = robot.robot->pose().p;
    while (simulation.now_ns() < end) {
      if (command_due.due(simulation.now_ns())) {
        const Pose here = robot.robot->pose();
        distance_m += (here.p - last).head<2>().norm();
        last = here.p;
        for (const auto& device : robot.devices) {
          for (const devices::Input& input : device->ports().all<devices::Input>()) {
            if (input.kind == devices::command_kind<Twist>())
              input.on_command(keeper.command(here));
          }
        }
      }
      simulation.step();
    }
    return duration_s / wall.elapsed_s();
  };
  const double settling = drive(arguments.number("--settle-s"));
  const double driving = drive(arguments.number("--duration-s"));
  std::cout << "{\"plants\": " << simulation.entities().size() - 2
            << ", \"settling_real_time_factor\": " << settling
            << ", \"real_time_factor\": " << driving << ", \"distance_m\": " << distance_m << "}\n";
}

}  // namespace
}  // namespace ardee::bench

int main(int argc, char** argv) {
  try {
    ardee::bench::run({argc,
                       argv,
                       {{"--robot", ""},
                        {"--plant", ""},
                        {"--plants", "880"},
                        {"--pose", "-1 0 0.175 0"},
                        {"--lane-m", "6"},
                        {"--speed-m-s", "0.5"},
                        {"--settle-s", "2"},
                        {"--duration-s", "10"}},
                       ardee::bench::kUsage});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "free_models_bench: " << error.what() << "\n";
    return 2;
  }
}
