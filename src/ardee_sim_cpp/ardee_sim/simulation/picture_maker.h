// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "ardee_sim/description/world.h"
#include "ardee_sim/devices/device.h"
#include "ardee_sim/render/looks.h"
#include "ardee_sim/render/renderer.h"
#include "ardee_sim/simulation/entity.h"

namespace ardee {

/// The pictures of a simulation, in the light of its world.
class PictureMaker : public Pictures {
 public:
  PictureMaker(const World& world, int threads,
               const std::vector<std::unique_ptr<Entity>>& entities, RayScenes& scenes, Log log)
      : world_(world), threads_(threads), entities_(entities), scenes_(scenes), looks_(log) {}

  Frame take(const Camera& camera, const FrameParts& parts) override;
  /// Models came or went: the next picture looks at them anew.
  void forget() { current_ = false; }
  /// The world's lights changed: the next picture is taken in the new light.
  void relight() { renderer_.reset(); }

 private:
  void look_at_models();

  const World& world_;
  const int threads_;
  const std::vector<std::unique_ptr<Entity>>& entities_;
  RayScenes& scenes_;
  Looks looks_;
  std::optional<Renderer> renderer_;  // of those looks
  bool current_ = false;
};

}  // namespace ardee
