// SPDX-License-Identifier: MIT
// Compares the speed of a lidar's rays in the engine with that of Embree alone on the same scenery.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "bench/bench_arguments.h"
#include "bench/embree_reference.h"
#include "bench/lane_keeper.h"
#include "bench/raycast_reference.h"
#include "bench/stopwatch.h"

namespace ardee::bench {
namespace {

constexpr const char* kUsage =
    "usage: lidar_bench --world FILE --robot FILE [--pose 'X Y Z YAW'] [--lane-m 6]\n"
    "         [--speed-m-s 0.5] [--scans 200] [--rounds 5] [--threads 1] [--radius-m 6]\n"
    "Prints JSON. Scans 25 ms apart on the robot's way down the lane, of the visual scene; only\n"
    "scenery is met. Rays are counted a second of processor time. radius-m: how near plants are\n"
    "triangles, not instances, in the scene that Embree is given.\n";

/// Rays of a lidar, and the places on its way where it sends them.
struct Scans {
  raycast::RayPattern pattern;
  float range_max_m = 0.0f;
  std::vector<Pose> poses_W;

  std::size_t rays() const { return pattern.directions_S.size() * poses_W.size(); }
  Eigen::Vector2d middle() const {
    return (poses_W.front().p.head<2>() + poses_W.back().p.head<2>()) / 2.0;
  }
  double half_way_m() const {
    return (poses_W.front().p - poses_W.back().p).head<2>().norm() / 2.0;
  }
};

/// Keeps a lidar's first scan.
class FirstScan : public devices::ReadingSink {
 public:
  void on_reading(const devices::Output& /*output*/, const devices::Reading& reading) override {
    const auto* scan = std::get_if<devices::LidarReading>(&reading);
    if (scan && found.ranges_m.empty()) found = *scan;
  }
  devices::LidarReading found;
};

/// Drives the robot and records the lidar's place, 40 times a second.
Scans drive(const BenchArguments& arguments, Loader& loader, Simulation& simulation) {
  constexpr double kScanRate_hz = 40.0;
  constexpr double kFirstScanLimit_s = 10.0;
  SpawnRequest request;
  request.name = "robot";
  request.model = loader.load_model(arguments.text("--robot"));
  request.X_WM = arguments.pose("--pose");
  const Entity& robot = simulation.spawn(request);
  FirstScan first;
  simulation.set_sink(&first);
  while (first.found.ranges_m.empty() || seconds(simulation.now_ns()) < 1.0) {
    simulation.step();
    if (seconds(simulation.now_ns()) > kFirstScanLimit_s) throw Error("no scan from the robot");
  }
  simulation.set_sink(nullptr);
  Scans scans;
  scans.range_max_m = static_cast<float>(first.found.range_max_m);
  for (std::size_t beam = 0; beam < first.found.ranges_m.size(); ++beam) {
    const double angle =
        first.found.angle_min_rad + static_cast<double>(beam) * first.found.angle_increment_rad;
    scans.pattern.directions_S.emplace_back(static_cast<float>(std::cos(angle)),
                                            static_cast<float>(std::sin(angle)), 0.0f);
  }
  const std::string lidar_link = "robot::" + first.found.header.frame_id;
  LaneKeeper keeper(arguments.pose("--pose"), arguments.number("--lane-m"),
                    arguments.number("--speed-m-s"));
  RateTimer due(kScanRate_hz);
  due.start_at(simulation.now_ns());
  for (const auto& device : robot.devices) {
    for (devices::Output& output : device->ports().all<devices::Output>()) output.demanded = false;
  }
  while (static_cast<double>(scans.poses_W.size()) < arguments.number("--scans")) {
    simulation.step();
    if (!due.due(simulation.now_ns())) continue;
    scans.poses_W.push_back(simulation.state(lidar_link, "world").pose);
    for (const auto& device : robot.devices) {
      for (const devices::Input& input : device->ports().all<devices::Input>()) {
        if (input.kind == devices::command_kind<Twist>()) {
          input.on_command(keeper.command(robot.robot->pose()));
        }
      }
    }
  }
  return scans;
}

/// Returns rays a second of processor time in the best of some rounds: other work on the machine
/// only slows a round down.
template <typename Round>
double best_rays_per_s(const Scans& scans, int rounds, const Round& round) {
  double best_s = 1e300;
  for (int k = 0; k < rounds; ++k) best_s = std::min(best_s, round());
  return static_cast<double>(scans.rays()) / best_s;
}

struct EngineResult {
  double rays_per_s = 0.0;
  double prepare_us = 0.0;
  double prepare_max_us = 0.0;
  std::size_t triangles = 0;
  std::vector<float> ranges_m;
};

EngineResult run_engine(const BenchArguments& arguments, const std::vector<Placement>& placements,
                        const Scans& scans) {
  EngineResult result;
  raycast::RayOptions options;
  options.threads = static_cast<int>(arguments.number("--threads"));
  options.local_scene_radius_m = arguments.number("--radius-m");
  raycast::RayScene scene(raycast::SceneKind::kVisual, options, Log());
  scene.add_scenery(0, placements);
  scene.prepare({scans.poses_W.front().p});
  std::vector<raycast::RayHit> hits;
  std::vector<double> prepare_us;
  const auto round = [&] {
    double cast_s = 0.0;
    result.ranges_m.clear();
    prepare_us.clear();
    for (const Pose& pose : scans.poses_W) {
      CpuStopwatch watch;
      scene.prepare({pose.p});
      prepare_us.push_back(watch.restart() * 1e6);
      scene.cast(pose, scans.pattern, scans.range_max_m, raycast::kNoEntity, 0, hits);
      cast_s += watch.elapsed_s();
      for (const raycast::RayHit& hit : hits) result.ranges_m.push_back(hit.range_m);
    }
    return cast_s;
  };
  result.rays_per_s = best_rays_per_s(scans, static_cast<int>(arguments.number("--rounds")), round);
  result.prepare_us = median(prepare_us);
  result.prepare_max_us = percentile(prepare_us, 1.0);
  result.triangles = scene.local_scene_triangles();
  return result;
}

double run_reference(const BenchArguments& arguments, const EmbreeReference& reference,
                     const Scans& scans, std::vector<float>& ranges_m) {
  const auto round = [&] {
    ranges_m.clear();
    ranges_m.reserve(scans.rays());
    const CpuStopwatch watch;
    for (const Pose& pose : scans.poses_W) {
      const Eigen::Quaternionf q = pose.q.cast<float>();
      const Eigen::Vector3f origin = pose.p.cast<float>();
      for (const Eigen::Vector3f& direction_S : scans.pattern.directions_S) {
        ranges_m.push_back(reference.cast(origin, q * direction_S, scans.range_max_m));
      }
    }
    return watch.elapsed_s();
  };
  return best_rays_per_s(scans, static_cast<int>(arguments.number("--rounds")), round);
}

/// Traces bare packets in the local scene that the engine itself commits about the middle of the
/// way. It leaves out the bodies beyond, which the engine would test next.
double run_committed(const BenchArguments& arguments, const std::vector<Placement>& placements,
                     const Scans& scans) {
  raycast::RayOptions options;
  options.local_scene_radius_m = arguments.number("--radius-m");
  Eigen::Vector3d middle_W(0, 0, 0);
  middle_W.head<2>() = scans.middle();
  const BareRegion region(placements, middle_W, options);
  const auto round = [&] {
    const CpuStopwatch watch;
    for (const Pose& pose : scans.poses_W) region.cast(pose, scans.pattern, scans.range_max_m);
    return watch.elapsed_s();
  };
  return best_rays_per_s(scans, static_cast<int>(arguments.number("--rounds")), round);
}

/// Returns the share of rays whose ranges agree to the millimetre.
double agreement(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t same = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    same += a[i] == b[i] || std::abs(a[i] - b[i]) < 1e-3f ? 1u : 0u;
  }
  return static_cast<double>(same) / static_cast<double>(a.size());
}

void run(const BenchArguments& arguments, std::ostream& out) {
  Loader loader(ResourceLocator::from_environment(), Log());
  Simulation simulation(loader.load_world(arguments.text("--world")), {},
                        [](LogLevel, const std::string&) {});
  const Scans scans = drive(arguments, loader, simulation);
  const std::vector<Placement> placements = scenery(simulation);
  const EngineResult engine = run_engine(arguments, placements, scans);
  const double reach_m = scans.half_way_m() + static_cast<double>(scans.range_max_m) + 1.0;
  std::vector<float> divided_m, flat_m;
  const auto divided = EmbreeReference::divided(
      placements, scans.middle(), scans.half_way_m() + arguments.number("--radius-m"), reach_m);
  const double divided_rays_per_s = run_reference(arguments, divided, scans, divided_m);
  const auto flat = EmbreeReference::flat(placements, scans.middle(), reach_m);
  const double flat_rays_per_s = run_reference(arguments, flat, scans, flat_m);
  const double committed_rays_per_s = run_committed(arguments, placements, scans);
  const auto hits = static_cast<double>(std::count_if(
      flat_m.begin(), flat_m.end(), [](float range) { return std::isfinite(range); }));
  out << "{\"placements\": " << placements.size() << ", \"scans\": " << scans.poses_W.size()
      << ", \"rays_a_scan\": " << scans.pattern.directions_S.size()
      << ", \"hit_share\": " << hits / static_cast<double>(flat_m.size())
      << ",\n \"rays_per_s\": " << engine.rays_per_s << ", \"prepare_us\": " << engine.prepare_us
      << ", \"prepare_max_us\": " << engine.prepare_max_us
      << ", \"local_scene_triangles\": " << engine.triangles
      << ",\n \"embree_rays_per_s\": " << divided_rays_per_s
      << ", \"embree_triangles\": " << divided.triangle_count()
      << ", \"embree_agreement\": " << agreement(engine.ranges_m, divided_m)
      << ",\n \"flat_rays_per_s\": " << flat_rays_per_s
      << ", \"flat_triangles\": " << flat.triangle_count()
      << ", \"flat_agreement\": " << agreement(engine.ranges_m, flat_m)
      << ",\n \"committed_rays_per_s\": " << committed_rays_per_s
      << ", \"of_committed\": " << engine.rays_per_s / committed_rays_per_s
      << ",\n \"of_embree\": " << engine.rays_per_s / divided_rays_per_s
      << ", \"of_flat\": " << engine.rays_per_s / flat_rays_per_s << "}\n";
}

}  // namespace
}  // namespace ardee::bench

int main(int argc, char** argv) {
  return ardee::bench::run_bench(
      argc, argv, {{"--scans", "200"}, {"--rounds", "5"}, {"--threads", "1"}, {"--radius-m", "6"}},
      ardee::bench::kUsage, [](const auto& arguments) { ardee::bench::run(arguments, std::cout); });
}
