// SPDX-License-Identifier: MIT
#include "ardee_sim/simulation/ray_scene_set.h"

#include <algorithm>

namespace ardee {
namespace {

std::vector<Pose> link_poses(const devices::Robot& robot) {
  std::vector<Pose> poses;
  poses.reserve(robot.model().links.size());
  for (std::size_t link = 0; link < robot.model().links.size(); ++link) {
    poses.push_back(robot.link_pose(link));
  }
  return poses;
}

}  // namespace

RaySceneSet::RaySceneSet(const raycast::RayOptions& options,
                         const std::vector<std::unique_ptr<Entity>>& entities, Log log)
    : options_(options), entities_(entities), log_(std::move(log)) {}

std::shared_ptr<void> RaySceneSet::register_eye(raycast::SceneKind kind, Eye eye) {
  auto shared = std::make_shared<Eye>(std::move(eye));
  view(kind).eyes.push_back(shared);
  return shared;
}

void RaySceneSet::add_to(raycast::RayScene& scene, const Entity& entity) {
  if (entity.is_static()) {
    scene.add_scenery(entity.robot->entity(), entity.placements);
  } else {
    scene.add_model(entity.robot->entity(), entity.robot->shared_model(), entity.instance.label);
  }
}

void RaySceneSet::add(const Entity& entity) {
  for (View& each : views_) {
    each.current = false;
    if (!each.scene) continue;
    try {
      add_to(*each.scene, entity);
    } catch (...) {
      for (View& view : views_) view.scene.reset();  // rebuilt without it on next use
      throw;
    }
  }
}

void RaySceneSet::remove(const Entity& entity) {
  for (View& each : views_) {
    if (!each.scene) continue;
    if (entity.is_static()) {
      each.scene->remove_scenery(entity.robot->entity());
    } else {
      each.scene->remove_model(entity.robot->entity());
    }
    each.rests.erase(entity.robot->entity());
    each.current = false;
  }
}

void RaySceneSet::invalidate() {
  for (View& each : views_) each.current = false;
}

const raycast::RayScene& RaySceneSet::for_pictures() {
  View& visual = view(raycast::SceneKind::kVisual);
  if (!visual.pictures) visual.current = false;
  visual.pictures = true;
  return now(raycast::SceneKind::kVisual);
}

raycast::PicturePlaces RaySceneSet::picture_places() {
  const View& visual = view(raycast::SceneKind::kVisual);
  return visual.scene ? visual.scene->picture_places() : raycast::PicturePlaces{};
}

void RaySceneSet::set_picture_places(const raycast::PicturePlaces& places) {
  View& visual = view(raycast::SceneKind::kVisual);
  visual.pictures = places.has_pictures;
  visual.current = false;
  if (visual.scene || places.has_pictures) {
    made(raycast::SceneKind::kVisual).set_picture_places(places);
  }
}

raycast::RayScene& RaySceneSet::made(raycast::SceneKind kind) {
  View& wanted = view(kind);
  if (!wanted.scene) {
    auto made = std::make_unique<raycast::RayScene>(kind, options_, log_);
    for (const auto& entity : entities_) add_to(*made, *entity);
    wanted.rests.clear();
    wanted.scene = std::move(made);  // only after complete success
  }
  return *wanted.scene;
}

const raycast::RayScene& RaySceneSet::now(raycast::SceneKind kind) {
  View& wanted = view(kind);
  made(kind);
  if (!wanted.current) {
    for (const auto& entity : entities_) {
      if (entity->is_static()) continue;
      const std::uint64_t rest = entity->robot->dynamics().rest();
      std::uint64_t& placed = wanted.rests[entity->robot->entity()];
      if (rest != 0 && rest == placed) continue;
      placed = rest;
      wanted.scene->set_link_poses(entity->robot->entity(), link_poses(*entity->robot));
    }
    std::vector<Eigen::Vector3d> eyes_W;
    auto& eyes = wanted.eyes;
    eyes.erase(
        std::remove_if(eyes.begin(), eyes.end(), [](const auto& eye) { return eye.expired(); }),
        eyes.end());
    for (const auto& eye : eyes) eyes_W.push_back((*eye.lock())());
    wanted.scene->prepare(eyes_W, wanted.pictures);
    wanted.current = true;
  }
  return *wanted.scene;
}

}  // namespace ardee
