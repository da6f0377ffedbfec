// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/render/material_library.h"
#include "ardee_sim/render/renderer.h"
#include "ardee_sim/simulation/entity.h"

namespace ardee {

/// The pictures of a simulation, in the light of its world.
class WorldCameraRenderer : public devices::CameraRenderer {
 public:
  WorldCameraRenderer(const Scene& scene, const std::vector<Light>& lights,
                      const std::optional<Daylight>& day, int threads,
                      const std::vector<std::unique_ptr<Entity>>& entities,
                      devices::RaySceneProvider& scenes, Log log)
      : scene_(scene),
        lights_(lights),
        daylight_(day),
        threads_(threads),
        entities_(entities),
        scenes_(scenes),
        materials_(log) {}

  render::Frame take(const render::Camera& camera, const render::FrameParts& parts) override;
  /// Called when models were added or removed: the next picture reloads their materials.
  void forget() { current_ = false; }
  /// Called when the world's lights changed: the next picture uses the new lights.
  void relight() { renderer_.reset(); }

 private:
  void load_materials();

  const Scene& scene_;
  const std::vector<Light>& lights_;
  const std::optional<Daylight>& daylight_;
  const int threads_;
  const std::vector<std::unique_ptr<Entity>>& entities_;
  devices::RaySceneProvider& scenes_;
  render::MaterialLibrary materials_;
  std::optional<render::Renderer> renderer_;  // of those materials
  bool current_ = false;
};

}  // namespace ardee
