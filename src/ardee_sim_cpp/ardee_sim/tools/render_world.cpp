// SPDX-License-Identifier: MIT
// Draws a picture of a world without a display.
#include <unistd.h>

#include <csignal>
#include <iostream>
#include <map>
#include <mutex>

#include "ardee_sim/description/collision_bodies.h"
#include "ardee_sim/raycast/ray_scene.h"
#include "ardee_sim/readers/loader.h"
#include "ardee_sim/render/renderer.h"
#include "ardee_sim/tools/default_view.h"
#include "ardee_sim/tools/render_arguments.h"

namespace ardee {
namespace {

constexpr int kBadInput = 2;
constexpr int kInterrupted = 130;
/// A picture has more and longer rays than a scan: splitting more plants pays off.
constexpr double kFlattenedRadius_m = 12.0;

volatile std::sig_atomic_t interrupted = 0;
void on_interrupt(int /*signal*/) { interrupted = 1; }

/// Progress line on the terminal, in whole percent.
class ProgressLine {
 public:
  ProgressLine() : shown_(isatty(STDERR_FILENO) == 1) {}
  ~ProgressLine() {
    if (percent_ >= 0) std::cerr << "\r\033[K";
  }
  void show(double share) {
    if (!shown_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    const int percent = static_cast<int>(100.0 * share);
    if (percent <= percent_) return;
    percent_ = percent;
    std::cerr << "\rdrawing: " << percent << " %" << std::flush;
  }

 private:
  const bool shown_;
  std::mutex mutex_;
  int percent_ = -1;
};

/// The world's scenery and models at their described poses, and the robot; with `collisions`, the
/// collision bodies of each.
void fill(raycast::RayScene& rays, render::MaterialLibrary& materials, const World& world,
          const std::shared_ptr<const Model>& robot, const Pose& robot_W, bool collisions) {
  std::vector<Placement> placements;
  std::map<std::shared_ptr<const Model>, std::shared_ptr<const Model>> bodies_of;
  const auto put = [&](const Instance& instance) {
    for (Placement& placement : flatten_scenery(instance)) {
      materials.add(placement.model);
      placements.push_back(placement);
      if (!collisions) continue;
      std::shared_ptr<const Model>& bodies = bodies_of[placement.model];
      if (!bodies) bodies = collision_bodies(*placement.model);
      materials.add(bodies);
      placement.model = bodies;
      placements.push_back(std::move(placement));
    }
  };
  for (const Instance& instance : world.models) put(instance);
  if (robot != nullptr) {
    Instance instance;
    instance.model = robot;
    instance.name = robot->name;
    instance.pose = robot_W * robot->own_pose;
    put(instance);
  }
  rays.add_scenery(0, placements);
}

render::Camera camera_of(const RenderArguments& arguments, const World& world,
                         raycast::RayScene& rays) {
  render::Camera camera;
  camera.width = arguments.width;
  camera.height = arguments.height;
  camera.horizontal_fov_rad = arguments.horizontal_fov_rad;
  if (arguments.camera_W) {
    camera.X_WC = *arguments.camera_W;
  } else if (world.gui_camera) {
    camera.X_WC = *world.gui_camera;
  } else {
    rays.prepare({});
    camera.X_WC = view_over(rays.scenery_boxes(), camera);
  }
  return camera;
}

int draw(const RenderArguments& arguments) {
  Log log([](LogLevel level, const std::string& text) {
    if (level >= LogLevel::kWarning) std::cerr << "render_world: " << text << '\n';
  });
  ResourceLocator locator = ResourceLocator::from_environment();
  locator.add_first_model_paths(arguments.model_paths);
  Loader loader(locator, log);
  const World world = loader.load_world(locator.find_world(arguments.world));
  const std::shared_ptr<const Model> robot =
      arguments.robot.empty() ? nullptr : loader.load_model(arguments.robot);
  raycast::RayOptions ray_options;
  ray_options.threads = arguments.threads;
  ray_options.local_scene_radius_m = kFlattenedRadius_m;
  raycast::RayScene rays(raycast::SceneKind::kVisual, ray_options, log);
  render::MaterialLibrary materials(log);
  fill(rays, materials, world, robot, arguments.robot_W, arguments.collisions);
  const render::Camera camera = camera_of(arguments, world, rays);
  rays.prepare({camera.X_WC.p});
  const render::Renderer renderer(rays.pictures(), materials, world.scene, world.lights);
  render::RenderOptions options;
  options.samples = arguments.samples;
  options.shadows = arguments.shadows;
  options.threads = arguments.threads;
  std::signal(SIGINT, on_interrupt);
  Image picture;
  {
    ProgressLine line;
    picture = renderer.render(camera, options, [&line](double share) {
      line.show(share);
      return interrupted == 0;
    });
  }
  if (interrupted != 0) {
    std::cerr << "render_world: interrupted; nothing is written\n";
    return kInterrupted;
  }
  write_png(arguments.output, picture);
  return 0;
}

int run(int argc, char** argv) {
  try {
    const RenderArguments arguments = parse_render_arguments(argc, argv);
    if (arguments.help) {
      std::cout << render_usage();
      return 0;
    }
    return draw(arguments);
  } catch (const std::exception& error) {
    std::cerr << "render_world: " << error.what() << '\n';
  }
  return kBadInput;
}

}  // namespace
}  // namespace ardee

int main(int argc, char** argv) { return ardee::run(argc, argv); }
