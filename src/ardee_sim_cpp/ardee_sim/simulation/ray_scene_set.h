// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/simulation/entity.h"

namespace ardee {

/// The visual and the collision scene of a simulation, each made on first use by a sensor.
class RaySceneSet : public devices::RaySceneProvider {
 public:
  RaySceneSet(const raycast::RayOptions& options,
              const std::vector<std::unique_ptr<Entity>>& entities, Log log);

  std::shared_ptr<void> register_eye(raycast::SceneKind kind, Eye eye) override;
  const raycast::RayScene& now(raycast::SceneKind kind) override;
  const raycast::RayScene& for_pictures() override;

  void add(const Entity& entity);
  void remove(const Entity& entity);
  /// Marks the scenes as outdated: the next use updates them.
  void invalidate();
  /// Where pictures are traced, as a part of a simulation's state.
  raycast::PicturePlaces picture_places();
  void set_picture_places(const raycast::PicturePlaces& places);

 private:
  struct View {
    std::unique_ptr<raycast::RayScene> scene;
    std::vector<std::weak_ptr<Eye>> eyes;
    bool current = false;
    std::map<std::uint32_t, std::uint64_t>
        rests;  // by entity: number of the model's rest at placing
    bool pictures = false;
  };
  static void add_to(raycast::RayScene& scene, const Entity& entity);
  raycast::RayScene& made(raycast::SceneKind kind);
  View& view(raycast::SceneKind kind) { return views_[static_cast<std::size_t>(kind)]; }

  raycast::RayOptions options_;
  const std::vector<std::unique_ptr<Entity>>& entities_;
  Log log_;
  std::array<View, 2> views_;
};

}  // namespace ardee
