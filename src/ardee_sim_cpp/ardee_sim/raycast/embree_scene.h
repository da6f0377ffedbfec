// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "ardee_sim/raycast/bounds.h"

struct RTCDeviceTy;
struct RTCSceneTy;
struct RTCIntersectFunctionNArguments;

namespace ardee::raycast {

/// Embree's device: collects its errors and counts its bytes.
class EmbreeDevice {
 public:
  EmbreeDevice();
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  RTCDeviceTy* get() const { return device_; }
  std::size_t bytes() const;
  /// Throws what Embree has complained about since the last call.
  void check() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
  RTCDeviceTy* device_;
};

enum class BuildQuality { kLow, kMedium };

/// A committed Embree scene over `count` boxes, whose contents are met by a callback of ours.
class EmbreeScene {
 public:
  using Meet = void (*)(const RTCIntersectFunctionNArguments*);
  using BoxOf = std::function<void(std::size_t, float lower[3], float upper[3])>;

  /// `owner` is what the callback gets as geometryUserPtr.
  EmbreeScene(const EmbreeDevice& device, std::size_t count, const BoxOf& box_of, Meet meet,
              void* owner, BuildQuality quality);
  ~EmbreeScene();
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  RTCSceneTy* get() const { return scene_; }

 private:
  RTCSceneTy* scene_;
};

/// Floats about a box that hold it for certain, also against a ray whose coordinates are floats of
/// that size.
void round_outwards(const Bounds& box, double extent, float lower[3], float upper[3]);

}  // namespace ardee::raycast
