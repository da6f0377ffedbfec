// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "ardee_sim/devices/device.h"
#include "ardee_sim/simulation/entity.h"

namespace ardee {

/// The visual and the collision scene of a simulation, each made when a sensor first needs it.
class SceneSet : public RayScenes {
 public:
  SceneSet(const RayOptions& options, const std::vector<std::unique_ptr<Entity>>& entities,
           Log log);

  std::shared_ptr<void> register_eye(SceneKind kind, Eye eye) override;
  const RayScene& now(SceneKind kind) override;
  const RayScene& for_pictures() override;

  void add(const Entity& entity);
  void remove(const Entity& entity);
  /// Something moved: the next use brings the scenes up to date.
  void invalidate();

 private:
  struct View {
    std::unique_ptr<RayScene> scene;
    std::vector<std::weak_ptr<Eye>> eyes;
    bool current = false;
    std::map<std::uint32_t, std::uint64_t> rests;  // of models, by entity, when they were placed
    bool pictures = false;
  };
  static void add_to(RayScene& scene, const Entity& entity);
  View& view(SceneKind kind) { return views_[static_cast<std::size_t>(kind)]; }

  RayOptions options_;
  const std::vector<std::unique_ptr<Entity>>& entities_;
  Log log_;
  std::array<View, 2> views_;
};

}  // namespace ardee
