// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/embree_scene.h"

#include <embree3/rtcore.h>

#include <atomic>
#include <mutex>

#include "ardee_sim/core/error.h"

namespace ardee::raycast {
namespace {

/// Rounding to float and Embree's own arithmetic cost a few parts in 2^24 of the coordinates.
constexpr double kRelativeMargin = 2e-6;
constexpr double kAbsoluteMargin_m = 1e-5;

struct BoxSource {
  const EmbreeScene::BoxOf* box_of;
  void* owner;
};

}  // namespace

struct EmbreeDevice::State {
  std::mutex mutex;
  std::string message;
  std::atomic<std::ptrdiff_t> bytes{0};
};

EmbreeDevice::EmbreeDevice() : state_(std::make_unique<State>()), device_(rtcNewDevice(nullptr)) {
  if (device_ == nullptr) throw Error("Embree cannot make a device on this machine");
  rtcSetDeviceErrorFunction(
      device_,
      [](void* user, RTCError, const char* text) {
        auto* state = static_cast<State*>(user);
        const std::lock_guard<std::mutex> lock(state->mutex);
        if (state->message.empty()) state->message = text != nullptr ? text : "unknown error";
      },
      state_.get());
  rtcSetDeviceMemoryMonitorFunction(
      device_,
      [](void* user, ssize_t bytes, bool) {
        static_cast<State*>(user)->bytes += bytes;
        return true;
      },
      state_.get());
}

EmbreeDevice::~EmbreeDevice() { rtcReleaseDevice(device_); }

std::size_t EmbreeDevice::bytes() const {
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, state_->bytes));
}

void EmbreeDevice::check() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  if (state_->message.empty()) return;
  const std::string message = "Embree: " + state_->message;
  state_->message.clear();
  throw Error(message);
}

EmbreeScene::EmbreeScene(const EmbreeDevice& device, std::size_t count, const BoxOf& box_of,
                         Meet meet, void* owner, BuildQuality quality)
    : scene_(rtcNewScene(device.get())) {
  RTCGeometry geometry = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
  BoxSource source{&box_of, owner};
  rtcSetGeometryUserData(geometry, &source);
  rtcSetGeometryBoundsFunction(
      geometry,
      [](const RTCBoundsFunctionArguments* args) {
        const auto* boxes = static_cast<const BoxSource*>(args->geometryUserPtr);
        (*boxes->box_of)(args->primID, &args->bounds_o->lower_x, &args->bounds_o->upper_x);
      },
      nullptr);
  rtcSetGeometryIntersectFunction(geometry, meet);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  const RTCBuildQuality level =
      quality == BuildQuality::kLow ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM;
  rtcSetSceneBuildQuality(scene_, level);
  rtcCommitScene(scene_);
  // Embree calls back for the boxes only while it builds; afterwards the callback needs its owner.
  rtcSetGeometryUserData(geometry, owner);
  rtcReleaseGeometry(geometry);
  try {
    device.check();
  } catch (...) {
    rtcReleaseScene(scene_);
    throw;
  }
}

EmbreeScene::~EmbreeScene() { rtcReleaseScene(scene_); }

void round_outwards(const Bounds& box, double extent, float lower[3], float upper[3]) {
  const double margin = kAbsoluteMargin_m + kRelativeMargin * extent;
  for (int k = 0; k < 3; ++k) {
    lower[k] = static_cast<float>(box.lower[k] - margin);
    upper[k] = static_cast<float>(box.upper[k] + margin);
  }
}

}  // namespace ardee::raycast
