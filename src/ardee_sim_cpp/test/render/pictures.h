// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>

#include "../raycast/scenes.h"
#include "ardee_sim/render/renderer.h"

namespace ardee::test {
using namespace raycast;
using namespace render;

/// Returns a matt surface that reflects `share` of direct light, and no ambient light.
inline Material matt(float share) {
  Material material;
  material.diffuse = Color(share, share, share, 1.0f);
  material.ambient = Color(0, 0, 0, 1);
  return material;
}

inline Light sun(const Eigen::Vector3d& direction) {
  Light light;
  light.direction = direction;
  light.cast_shadows = true;
  return light;
}

/// Stage with a black background and only the lights that a test adds.
struct TestStage {
  TestStage() {
    scene.background = Color(0, 0, 0, 1);
    scene.ambient = Color(0, 0, 0, 1);
  }

  Image picture(const Camera& camera, const RenderOptions& options = {}) const {
    MaterialLibrary materials((Log()));
    RayScene rays(SceneKind::kVisual, {}, Log());
    for (const Placement& placement : placements) materials.add(placement.model);
    rays.add_scenery(0, placements);
    rays.prepare({camera.X_WC.p});
    return Renderer(rays.pictures(), materials, scene, lights).render(camera, options);
  }

  Scene scene;
  std::vector<Light> lights;
  std::vector<Placement> placements;
};

/// Returns a camera that looks straight down from `height_m`, x upwards in the picture and y to the
/// left.
inline Camera from_above(double height_m, int side_px = 101) {
  Camera camera;
  camera.X_WC = Pose::from_xyz_rpy({0, 0, height_m}, {0, 0.5 * kPi, 0});
  camera.width = camera.height = side_px;
  return camera;
}

inline int red_at(const Image& image, const Eigen::Vector2d& place_px) {
  return image.samples8[image.index(static_cast<int>(std::floor(place_px.x())),
                                    static_cast<int>(std::floor(place_px.y())))];
}

/// Returns the number of pixels that are not black.
inline int lit_pixels(const Image& image) {
  int count = 0;
  for (std::size_t i = 0; i < image.samples8.size(); i += 4) {
    count += image.samples8[i] + image.samples8[i + 1] + image.samples8[i + 2] > 0 ? 1 : 0;
  }
  return count;
}

}  // namespace ardee::test
