// SPDX-License-Identifier: MIT
// Times the engine without ROS: a world, a robot that drives to and fro in a lane, and its lidars.
#include <iostream>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "bench/bench_arguments.h"
#include "bench/lane_keeper.h"
#include "bench/stopwatch.h"

namespace ardee::bench {
namespace {

constexpr const char* kUsage =
    "usage: simulation_bench --world FILE --robot FILE [--pose 'X Y Z YAW'] [--lane-m 6]\n"
    "         [--speed-m-s 0.5] [--duration-s 60] [--settle-s 1] [--seed 0] [--threads 0]\n"
    "Prints JSON. Durations are simulated ones, of each of three phases: nothing is read, lidars\n"
    "only, all but pictures and clouds.\n";

/// Counts the devices' readings.
class Counter : public devices::ReadingSink {
 public:
  void on_reading(const devices::Output& /*output*/, const devices::Reading& reading) override {
    ++readings;
    if (const auto* scan = std::get_if<devices::LidarReading>(&reading)) {
      ++scans;
      rays += scan->ranges_m.size();
    }
  }
  std::uint64_t readings = 0;
  std::uint64_t scans = 0;
  std::uint64_t rays = 0;
};

/// Costs of one phase of the drive.
struct Phase {
  double simulated_s = 0.0;
  double wall_s = 0.0;
  double cpu_s = 0.0;  // all threads
  std::uint64_t scans = 0;
  std::uint64_t rays = 0;
  std::uint64_t readings = 0;
  std::vector<double> plain_steps_us;  // steps without a scan
  std::vector<double> scan_steps_us;

  void print(std::ostream& out) const {
    out << "{\"real_time_factor\": " << simulated_s / wall_s
        << ", \"step_us\": " << median(plain_steps_us)
        << ", \"step_p99_us\": " << percentile(plain_steps_us, 0.99) << ", \"mean_step_us\": "
        << wall_s * 1e6 / static_cast<double>(plain_steps_us.size() + scan_steps_us.size());
    if (scans > 0) {
      const double scan_us = median(scan_steps_us) - median(plain_steps_us);
      const double rays_a_scan = static_cast<double>(rays) / static_cast<double>(scans);
      out << ", \"scans\": " << scans << ", \"scan_us\": " << scan_us
          << ", \"scan_p99_us\": " << percentile(scan_steps_us, 0.99) - median(plain_steps_us)
          << ", \"rays_per_s\": " << rays_a_scan / scan_us * 1e6;
    }
    out << ", \"cpu_s_per_simulated_s\": " << cpu_s / simulated_s << ", \"readings\": " << readings
        << "}";
  }
};

/// Loads, spawns and drives.
class Bench {
 public:
  explicit Bench(const BenchArguments& arguments) : arguments_(arguments) {}

  void run(std::ostream& out) {
    const Stopwatch all;
    Loader loader(ResourceLocator::from_environment(), Log());
    Stopwatch part;
    const World world = loader.load_world(arguments_.text("--world"));
    const double load_s = part.restart();
    SimulationOptions options;
    options.seed = static_cast<std::uint64_t>(arguments_.number("--seed"));
    options.rays.threads = static_cast<int>(arguments_.number("--threads"));
    Simulation simulation(world, options, to_stderr);
    simulation.set_sink(&counter_);
    const double build_s = part.restart();
    spawn(loader, simulation);
    const double spawn_s = part.restart();
    while (counter_.scans == 0) {
      simulation.step();
      if (seconds(simulation.now_ns()) > kFirstScanLimit_s) {
        throw Error("no scan: expected a robot with a lidar");
      }
    }
    const double first_scan_s = part.restart();
    out << "{\"placements\": " << placements(simulation) << ", \"load_s\": " << load_s
        << ", \"build_s\": " << build_s << ", \"spawn_s\": " << spawn_s
        << ", \"first_scan_s\": " << first_scan_s << ", \"start_s\": " << all.elapsed_s()
        << ",\n \"rss_at_start_mb\": " << memory_mb("VmRSS");
    drive_all(simulation, out);
    out << ",\n \"rss_mb\": " << memory_mb("VmRSS") << ", \"peak_rss_mb\": " << memory_mb("VmHWM")
        << ", \"distance_m\": " << distance_m_ << "}\n";
  }

 private:
  static constexpr double kFirstScanLimit_s = 10.0;
  static constexpr double kCommandPeriod_s = 0.05;

  static void to_stderr(LogLevel level, const std::string& text) {
    if (level == LogLevel::kWarning || level == LogLevel::kError) std::cerr << text << "\n";
  }

  static std::size_t placements(const Simulation& simulation) {
    std::size_t count = 0;
    for (const auto& entity : simulation.entities()) count += entity->placements.size();
    return count;
  }

  void spawn(Loader& loader, Simulation& simulation) {
    SpawnRequest request;
    request.name = "robot";
    request.model = loader.load_model(arguments_.text("--robot"));
    request.X_WM = arguments_.pose("--pose");
    robot_ = &simulation.spawn(request);
  }

  void demand(bool lidars, bool rest) {
    for (const auto& device : robot_->devices) {
      for (devices::Output& output : device->ports().all<devices::Output>()) {
        const bool scan = output.kind == devices::reading_kind<devices::LidarReading>();
        const bool picture = output.kind == devices::reading_kind<devices::ImageReading>() ||
                             output.kind == devices::reading_kind<devices::PointCloudReading>();
        output.demanded = !picture && (scan ? lidars : rest);
      }
    }
  }

  void drive_all(Simulation& simulation, std::ostream& out) {
    demand(false, false);
    const TimeNs settled = simulation.now_ns() + nanoseconds(arguments_.number("--settle-s"));
    while (simulation.now_ns() < settled) simulation.step();
    LaneKeeper keeper(arguments_.pose("--pose"), arguments_.number("--lane-m"),
                      arguments_.number("--speed-m-s"));
    const auto phase = [&](const char* name, bool lidars, bool rest) {
      demand(lidars, rest);
      out << ",\n \"" << name << "\": ";
      drive(simulation, keeper).print(out);
    };
    phase("nothing_read", false, false);
    phase("lidars", true, false);
    phase("all_but_pictures", true, true);
  }

  Phase drive(Simulation& simulation, LaneKeeper& keeper) {
    Phase phase;
    const TimeNs start = simulation.now_ns();
    const TimeNs end = start + nanoseconds(arguments_.number("--duration-s"));
    const Counter before = counter_;
    const CpuStopwatch cpu;
    RateTimer command_due(1.0 / kCommandPeriod_s);
    command_due.start_at(start);
    Eigen::Vector3d last = robot_->robot->pose().p;
    while (simulation.now_ns() < end) {
      if (command_due.due(simulation.now_ns())) {
        const Pose here = robot_->robot->pose();
        distance_m_ += (here.p - last).head<2>().norm();
        last = here.p;
        command(keeper.command(here));
      }
      const std::uint64_t scans = counter_.scans;
      const Stopwatch step;
      simulation.step();
      const double step_s = step.elapsed_s();
      phase.wall_s += step_s;
      (counter_.scans > scans ? phase.scan_steps_us : phase.plain_steps_us).push_back(step_s * 1e6);
    }
    phase.cpu_s = cpu.elapsed_s();
    phase.simulated_s = seconds(simulation.now_ns() - start);
    phase.scans = counter_.scans - before.scans;
    phase.rays = counter_.rays - before.rays;
    phase.readings = counter_.readings - before.readings;
    return phase;
  }

  void command(const Twist& twist) {
    for (const auto& device : robot_->devices) {
      for (const devices::Input& input : device->ports().all<devices::Input>()) {
        if (input.kind == devices::command_kind<Twist>()) input.on_command(twist);
      }
    }
  }

  const BenchArguments& arguments_;
  Counter counter_;
  Entity* robot_ = nullptr;
  double distance_m_ = 0.0;
};

}  // namespace
}  // namespace ardee::bench

int main(int argc, char** argv) {
  return ardee::bench::run_bench(
      argc, argv,
      {{"--duration-s", "60"}, {"--settle-s", "1"}, {"--seed", "0"}, {"--threads", "0"}},
      ardee::bench::kUsage,
      [](const auto& arguments) { ardee::bench::Bench(arguments).run(std::cout); });
}
