// SPDX-License-Identifier: MIT
// Renders the pictures of three cameras in a field, and traces the same rays by Embree alone.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "ardee_sim/devices/camera_sensor.h"
#include "ardee_sim/readers/loader.h"
#include "ardee_sim/simulation/simulation.h"
#include "bench/bench_arguments.h"
#include "bench/embree_reference.h"
#include "bench/stopwatch.h"

namespace ardee::bench {
namespace {

constexpr const char* kUsage =
    "usage: camera_bench --world FILE [--robot FILE] [--pose 'X Y Z YAW'] [--lane-m 6]\n"
    "         [--speed-m-s 0.5] [--height-m 0.3] [--duration-s 1] [--rounds 2] [--threads 0]\n"
    "         [--reach-m 40]\n"
    "Prints JSON. Three cameras of 640 x 480 at 10 Hz look ahead, to the left and to the right as\n"
    "they go down the lane (without a robot: its file is not read); then the same rays through the "
    "pixels' middles by bare Embree.\n";

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr double kRate_hz = 10.0;
constexpr double kFov_rad = 1.2;
constexpr double kStep_s = 0.005;
const double kYaws_rad[] = {0.0, 0.5 * M_PI, -0.5 * M_PI};

/// Returns a body without weight that carries the cameras.
std::string carrier() {
  std::string xml =
      "<sdf version='1.6'><model name='carrier'><link name='body'><gravity>false</gravity>";
  int number = 0;
  for (const double yaw : kYaws_rad) {
    const std::string name = "camera" + std::to_string(number++);
    xml += "<sensor name='" + name + "' type='camera'><pose>0 0 0 0 0 " + std::to_string(yaw) +
           "</pose><update_rate>" + std::to_string(kRate_hz) +
           "</update_rate><camera><horizontal_fov>" + std::to_string(kFov_rad) +
           "</horizontal_fov><image><width>" + std::to_string(kWidth) + "</width><height>" +
           std::to_string(kHeight) +
           "</height></image><noise><type>gaussian</type><mean>0</mean><stddev>0.007</stddev>"
           "</noise></camera><plugin name='p' filename='libgazebo_ros_camera.so'><cameraName>" +
           name + "</cameraName><frameName>body</frameName></plugin></sensor>";
  }
  return xml + "</link></model></sdf>";
}

/// Counts pictures.
class Counter : public devices::ReadingSink {
 public:
  void on_reading(const devices::Output& /*output*/, const devices::Reading& reading) override {
    if (std::holds_alternative<devices::ImageReading>(reading)) ++frames;
  }
  int frames = 0;
};

struct Drive {
  double wall_s = 1e300;
  double cpu_s = 1e300;
  int frames = 0;
  std::vector<double> steps_ms;  // of all rounds but the first: steps with pictures
  std::vector<Pose> poses_W;     // poses of the carrier when pictures were taken
};

/// Drives down the lane for a while, `rounds` times, each from the end of the last; the best times
/// count.
Drive drive(const BenchArguments& arguments, Simulation& simulation, Entity& carrier_entity) {
  Drive best;
  Counter counter;
  simulation.set_sink(&counter);
  RelativeState start;
  start.pose = arguments.pose("--pose");
  start.pose.p.z() += arguments.number("--height-m");
  start.twist.linear = start.pose.q * Eigen::Vector3d(arguments.number("--speed-m-s"), 0, 0);
  const int steps = static_cast<int>(arguments.number("--duration-s") / kStep_s);
  simulation.set_state("carrier", start, "world");
  for (int round = 0; round <= static_cast<int>(arguments.number("--rounds")); ++round) {
    counter.frames = 0;
    std::vector<Pose> poses_W;
    const Stopwatch wall;
    const CpuStopwatch cpu;
    for (int k = 0; k < steps; ++k) {
      const int before = counter.frames;
      const Stopwatch step;
      simulation.step();
      if (counter.frames == before) continue;
      if (round > 0) best.steps_ms.push_back(1e3 * step.elapsed_s());
      poses_W.push_back(carrier_entity.robot->pose());
    }
    if (round == 0) continue;  // textures and near regions are made here
    best.wall_s = std::min(best.wall_s, wall.elapsed_s());
    best.cpu_s = std::min(best.cpu_s, cpu.elapsed_s());
    best.frames = counter.frames;
    best.poses_W = poses_W;
  }
  simulation.set_sink(nullptr);
  return best;
}

/// Returns rays a second of processor time of bare Embree, one thread, over every picture of the
/// drive.
double embree_rays_per_s(const BenchArguments& arguments, const Simulation& simulation,
                         const Drive& done) {
  const auto flat = EmbreeReference::flat(scenery(simulation), done.poses_W.front().p.head<2>(),
                                          arguments.number("--reach-m"));
  render::Camera camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.horizontal_fov_rad = kFov_rad;
  std::vector<Eigen::Vector3f> directions_C;
  for (int k = 0; k < kWidth * kHeight; ++k) {
    directions_C.push_back(
        camera.direction_C(k % kWidth + 0.5, k / kWidth + 0.5).normalized().cast<float>());
  }
  double best_s = 1e300;
  std::size_t met = 0;
  for (int round = 0; round < static_cast<int>(arguments.number("--rounds")); ++round) {
    const CpuStopwatch watch;
    for (const Pose& pose : done.poses_W) {
      for (const double yaw : kYaws_rad) {
        const Pose X_WC = pose * Pose::from_xyz_rpy({0, 0, 0}, {0, 0, yaw});
        const Eigen::Matrix3f R_WC = X_WC.q.toRotationMatrix().cast<float>();
        const Eigen::Vector3f origin = X_WC.p.cast<float>();
        for (const Eigen::Vector3f& direction_C : directions_C) {
          met += flat.cast(origin, R_WC * direction_C, 100.0f) < 100.0f ? 1u : 0u;
        }
      }
    }
    best_s = std::min(best_s, watch.elapsed_s());
  }
  if (met == 0) throw Error("no ray of the cameras meets anything");
  return static_cast<double>(done.poses_W.size() * 3 * directions_C.size()) / best_s;
}

void run(const BenchArguments& arguments, std::ostream& out) {
  Loader loader(ResourceLocator::from_environment(), Log());
  World world = loader.load_world(arguments.text("--world"));
  world.physics.step_s = kStep_s;
  SimulationOptions options;
  options.rays.threads = static_cast<int>(arguments.number("--threads"));
  Simulation simulation(world, options,
                        [](LogLevel, const std::string& text) { std::cerr << text << '\n'; });
  SpawnRequest request;
  request.name = "carrier";
  request.model = loader.load_model_text(carrier(), "carrier.sdf");
  request.X_WM = arguments.pose("--pose");
  const Drive done = drive(arguments, simulation, simulation.spawn(request));
  if (done.frames == 0) throw Error("the cameras took no picture");
  const double rays_a_frame = static_cast<double>(kWidth) * kHeight;
  const double cpu_a_frame_s = done.cpu_s / done.frames;
  const double embree = embree_rays_per_s(arguments, simulation, done);
  out << "{\"frames\": " << done.frames << ", \"frames_per_s\": " << done.frames / done.wall_s
      << ", \"real_time_factor\": " << arguments.number("--duration-s") / done.wall_s
      << ",\n \"step_ms\": " << median(done.steps_ms)
      << ", \"longest_step_ms\": " << percentile(done.steps_ms, 1.0)
      << ",\n \"cpu_ms_a_frame\": " << 1e3 * cpu_a_frame_s
      << ", \"pixels_per_cpu_s\": " << rays_a_frame / cpu_a_frame_s
      << ",\n \"embree_rays_per_s\": " << embree
      << ", \"of_embree\": " << rays_a_frame / cpu_a_frame_s / embree << "}\n";
}

}  // namespace
}  // namespace ardee::bench

int main(int argc, char** argv) {
  return ardee::bench::run_bench(
      argc, argv,
      {{"--robot", "none"},
       {"--height-m", "0.3"},
       {"--duration-s", "1"},
       {"--rounds", "2"},
       {"--reach-m", "40"},
       {"--threads", "0"}},
      ardee::bench::kUsage, [](const auto& arguments) { ardee::bench::run(arguments, std::cout); });
}
