// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/traced_scene.h"

#include <algorithm>
#include <limits>

namespace ardee::raycast {

TracedScene::TracedScene(SceneKind kind, const RayOptions& options, Log own_log)
    : log(std::move(own_log)),
      scenery(kind, log),
      moving(kind, log),
      local_scenes(scenery, moving, options) {}

void TracedScene::trace(RayQuery queries[kPacketRays], int count, const LocalScene* local) const {
  double t_leave[kPacketRays];
  double t_high[kPacketRays];
  double t_low[kPacketRays];
  for (int i = 0; i < count; ++i) scenery.fixed()->intersect_unbounded(queries[i]);
  moving.intersect(queries, count);
  for (int i = 0; i < kPacketRays; ++i) {
    t_low[i] = std::numeric_limits<double>::infinity();
    t_high[i] = -1.0;
    if (i >= count) continue;
    t_leave[i] = local != nullptr ? local->exit_t(queries[i].ray_W()) : 0.0;
    t_high[i] = std::min(queries[i].reach(), t_leave[i]);
  }
  if (local != nullptr) local->intersect(queries, t_high);
  bool onwards = false;
  for (int i = 0; i < count; ++i) {
    if (local != nullptr && queries[i].reach() <= t_leave[i]) continue;
    t_low[i] = t_leave[i];
    onwards = true;
  }
  if (onwards) scenery.fixed()->places().intersect(queries, t_low);
}

void TracedScene::trace(const SceneRay* rays, int count, RayQuery::Purpose purpose,
                        std::uint32_t own_entity, std::uint32_t own_link,
                        RayQuery queries[kPacketRays]) const {
  const LocalSceneInUse* found = local_scenes.find(rays[0].origin_W);
  const LocalScene* local = found != nullptr ? found->scene.get() : nullptr;
  for (int k = 0; k < count; ++k) {
    const SceneRay& ray = rays[k];
    queries[k].start({ray.origin_W, ray.direction_W}, ray.reach_m, own_entity, own_link, purpose);
    if (local != nullptr && local->depth_m(ray.origin_W) <= 0.0) local = nullptr;
  }
  trace(queries, count, local);
}

void TracedScene::require_committed() const {
  if (!scenery.committed()) throw Error("ray scene: prepare() must follow a change of scenery");
}

}  // namespace ardee::raycast
