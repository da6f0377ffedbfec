// SPDX-License-Identifier: MIT
// Times the ray scene in a field of procedural plants: at rest, driving, and compared with bare
// Embree.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <thread>

#include "bench/raycast_field.h"
#include "bench/raycast_reference.h"
#include "bench/stopwatch.h"

namespace ardee::bench {
namespace {

constexpr const char* kUsage =
    "usage: raycast_bench [--json] [--instances] [--radius-m R] [PLANTS ...]\n"
    "Lidar scans of 1081 beams to 10 m at 0.25 m above ground, and images of 320 x 240 rays, in "
    "fields\n"
    "of 8 plants a square metre; one thread. Default: 200 2000 20000 200000 plants.\n";
constexpr float kRange_m = 10.0f;
constexpr double kEyeHeight_m = 0.25;
constexpr double kRow_m = 0.76;
/// Speed of a robot at 0.5 m/s at 30 times real time, with scans of 40 Hz simulated.
constexpr double kWallSpeed_m_per_s = 15.0;
constexpr double kScanStep_m = 0.5 / 40.0;
constexpr int kRepeats = 5;

struct Options {
  bool json = false;
  raycast::RayOptions rays;
  std::vector<std::size_t> counts;
};

raycast::RayPattern lidar_pattern() {
  raycast::RayPattern pattern;
  for (int k = 0; k < 1081; ++k) {
    const double angle = (-135.0 + 0.25 * k) * M_PI / 180.0;
    pattern.directions_S.emplace_back(static_cast<float>(std::cos(angle)),
                                      static_cast<float>(std::sin(angle)), 0.0f);
  }
  return pattern;
}

raycast::RayPattern camera_pattern() {
  raycast::RayPattern pattern;
  for (int row = 0; row < 240; ++row) {
    for (int column = 0; column < 320; ++column) {
      pattern.directions_S.push_back(Eigen::Vector3f(1.0f,
                                                     static_cast<float>(160 - column) / 277.0f,
                                                     static_cast<float>(120 - row) / 277.0f)
                                         .normalized());
    }
  }
  return pattern;
}

/// Returns places between two rows about the middle of the field, slightly tilted as on rough
/// ground.
std::vector<Pose> lane_poses(int count, double step_m, double start_m) {
  std::vector<Pose> poses;
  for (int k = 0; k < count; ++k) {
    poses.push_back(Pose::from_xyz_rpy(
        {start_m + step_m * k, 0.5 * kRow_m + 0.05 * std::cos(3.0 * k), kEyeHeight_m},
        {0.02 * std::sin(k), 0.02 * std::cos(k), 0.1 * std::sin(0.01 * k)}));
  }
  return poses;
}

/// Returns the processor time of this thread [s]; other programs disturb it less than wall time.
double thread_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double process_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Returns rays a second in the best of some runs.
template <typename Run>
double rate_mrays(std::size_t rays, Run run) {
  double best_s = 1e9;
  for (int k = 0; k < kRepeats; ++k) {
    const double before_s = thread_s();
    run();
    best_s = std::min(best_s, thread_s() - before_s);
  }
  return 1e-6 * static_cast<double>(rays) / best_s;
}

struct Rates {
  double scene = 0.0;
  double bare = 0.0;
  double flat = 0.0;
};

Rates standing(const raycast::RayScene& scene, const BareRegion& bare, const FlatField& flat,
               const std::vector<Pose>& poses, const raycast::RayPattern& pattern) {
  const std::size_t rays = poses.size() * pattern.directions_S.size();
  std::vector<raycast::RayHit> hits;
  Rates rates;
  rates.scene = rate_mrays(rays, [&] {
    for (const Pose& pose : poses) scene.cast(pose, pattern, kRange_m, raycast::kNoEntity, 0, hits);
  });
  rates.bare = rate_mrays(rays, [&] {
    for (const Pose& pose : poses) bare.cast(pose, pattern, kRange_m);
  });
  rates.flat = rate_mrays(rays, [&] {
    for (const Pose& pose : poses) flat.cast(pose, pattern, kRange_m);
  });
  return rates;
}

struct Drive {
  double mrays = 0.0;
  double longest_prepare_ms = 0.0;
  double cores = 0.0;             // cores that all threads need at that pace
  double background_cores = 0.0;  // part of these in the background thread
};

/// Scans as in a simulation at 30 times real time: 1200 scans a second, slowed down to that pace if
/// there is time.
Drive drive(raycast::RayScene& scene, double side_m, const raycast::RayPattern& pattern) {
  const double length_m = std::min(60.0, 0.8 * side_m);
  const int scans = std::max(200, static_cast<int>(length_m / kScanStep_m));
  const auto poses = lane_poses(scans, length_m / scans, -0.5 * length_m);
  std::vector<raycast::RayHit> hits;
  Drive result;
  const double before_s = thread_s();
  const double all_before_s = process_s();
  const Stopwatch watch;
  for (int k = 0; k < scans; ++k) {
    const Pose& pose = poses[static_cast<std::size_t>(k)];
    const double prepare_s = thread_s();
    scene.prepare({pose.p});
    if (k > 0) {
      result.longest_prepare_ms =
          std::max(result.longest_prepare_ms, 1e3 * (thread_s() - prepare_s));
    }
    scene.cast(pose, pattern, kRange_m, raycast::kNoEntity, 0, hits);
    const double ahead_s = (k + 1) * kScanStep_m / kWallSpeed_m_per_s - watch.elapsed_s();
    if (ahead_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(ahead_s));
  }
  const double own_s = thread_s() - before_s;
  const double due_s = scans * kScanStep_m / kWallSpeed_m_per_s;
  result.mrays = 1e-6 * scans * static_cast<double>(pattern.directions_S.size()) / own_s;
  result.cores = (process_s() - all_before_s) / due_s;
  result.background_cores = result.cores - own_s / due_s;
  return result;
}

void run(const Options& options, std::size_t count, bool first) {
  const auto field = make_field(count);
  const raycast::RayPattern lidar = lidar_pattern();
  const Stopwatch start;
  raycast::RayScene scene(raycast::SceneKind::kVisual, options.rays, Log());
  scene.add_scenery(0, field);
  scene.prepare({});
  const double add_s = start.elapsed_s();
  const Eigen::Vector3d eye(0.0, 0.5 * kRow_m, kEyeHeight_m);
  scene.prepare({eye});
  std::vector<raycast::RayHit> hits;
  scene.cast({eye, Eigen::Quaterniond::Identity()}, lidar, kRange_m, raycast::kNoEntity, 0, hits);
  const double first_scan_s = start.elapsed_s();
  const double resident_mb = memory_mb("VmRSS");
  const double embree_mb = 1e-6 * static_cast<double>(scene.memory_bytes());
  const Drive driven = drive(scene, field_side_m(count), lidar);
  scene.prepare({eye});
  const BareRegion bare(field, eye, options.rays);
  const FlatField flat(field, 13.0);
  const Rates scan = standing(scene, bare, flat, lane_poses(200, 0.005, -0.5), lidar);
  const Rates image = standing(scene, bare, flat, lane_poses(8, 0.1, -0.4), camera_pattern());
  if (options.json) {
    std::printf(
        "%s{\"plants\": %zu, \"add_s\": %.4f, \"first_scan_s\": %.4f, \"scene_mb\": %.1f, "
        "\"resident_mb\": %.1f, \"lidar_mrays\": %.3f, \"lidar_bare_mrays\": %.3f, "
        "\"lidar_flat_mrays\": %.3f, \"camera_mrays\": %.3f, \"camera_bare_mrays\": %.3f, "
        "\"camera_flat_mrays\": %.3f, \"driving_mrays\": %.3f, \"driving_cores\": %.3f, "
        "\"background_cores\": %.3f, "
        "\"longest_prepare_ms\": %.2f}",
        first ? "" : ",\n ", count, add_s, first_scan_s, embree_mb, resident_mb, scan.scene,
        scan.bare, scan.flat, image.scene, image.bare, image.flat, driven.mrays, driven.cores,
        driven.background_cores, driven.longest_prepare_ms);
    return;
  }
  std::printf("%7zu plants: added %.3f s, first scan %.3f s, scene %.1f MB, process %.1f MB\n",
              count, add_s, first_scan_s, embree_mb, resident_mb);
  std::printf("  lidar  %.2f Mrays/s: %.0f %% of bare (%.2f), %.0f %% of one flat BVH (%.2f)\n",
              scan.scene, 100 * scan.scene / scan.bare, scan.bare, 100 * scan.scene / scan.flat,
              scan.flat);
  std::printf("  camera %.2f Mrays/s: %.0f %% of bare (%.2f), %.0f %% of one flat BVH (%.2f)\n",
              image.scene, 100 * image.scene / image.bare, image.bare,
              100 * image.scene / image.flat, image.flat);
  std::printf(
      "  driving at 15 m/s: %.2f Mrays/s while casting, %.2f cores (%.2f in the background), "
      "prepare <= %.2f ms\n",
      driven.mrays, driven.cores, driven.background_cores, driven.longest_prepare_ms);
}

bool parse(int argc, char** argv, Options& options) {
  options.rays.threads = 1;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--json") {
      options.json = true;
    } else if (word == "--instances") {
      options.rays.local_scenes = false;
    } else if (word == "--radius-m" && k + 1 < argc) {
      options.rays.local_scene_radius_m = std::atof(argv[++k]);
    } else if (const long count = std::atol(word.c_str()); count > 0) {
      options.counts.push_back(static_cast<std::size_t>(count));
    } else {
      return false;
    }
  }
  if (options.counts.empty()) options.counts = {200, 2000, 20000, 200000};
  return true;
}

}  // namespace
}  // namespace ardee::bench

int main(int argc, char** argv) {
  ardee::bench::Options options;
  if (!ardee::bench::parse(argc, argv, options)) {
    std::cerr << ardee::bench::kUsage;
    return 2;
  }
  if (options.json) std::printf("[");
  for (std::size_t k = 0; k < options.counts.size(); ++k) {
    ardee::bench::run(options, options.counts[k], k == 0);
  }
  if (options.json) std::printf("]\n");
  return 0;
}
