// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "ardee_sim/raycast/bounds.h"

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCIntersectFunctionNArguments;

namespace ardee::raycast {

/// Returns the Embree device of this process, which all scenes share. Throws Error if Embree cannot
/// make one.
RTCDeviceTy* embree_device();
/// Returns the bytes that Embree holds for all scenes of this process.
std::size_t embree_bytes();
/// Throws the first error that Embree has reported to this thread since the last call.
void check_embree();

enum class BuildQuality { kLow, kMedium };

/// Committed Embree scene over `count` boxes; a callback intersects their contents.
class EmbreeScene {
 public:
  using Meet = void (*)(const RTCIntersectFunctionNArguments*);
  using BoxOf = std::function<void(std::size_t, float lower[3], float upper[3])>;

  /// Builds the scene. The callback gets `owner` as geometryUserPtr.
  EmbreeScene(std::size_t count, const BoxOf& box_of, Meet meet, void* owner, BuildQuality quality);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCSceneTy* get() const { return scene_; }

 private:
  RTCSceneTy* scene_;
};

/// Rounds a box to floats that certainly contain it, also for rays with float coordinates of that
/// size.
void round_outwards(const Bounds& box, double extent, float lower[3], float upper[3]);

}  // namespace ardee::raycast
