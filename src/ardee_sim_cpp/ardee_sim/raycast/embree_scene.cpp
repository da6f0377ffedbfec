// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/embree_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

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

/// First error of a call of this thread, which Embree reports in the thread that called it.
thread_local std::string message;

/// The process's device, which counts its bytes.
class Device {
 public:
  Device() : device_(rtcNewDevice(nullptr)) {
    if (device_ == nullptr) throw Error("Embree cannot make a device on this machine");
    rtcSetDeviceErrorFunction(
        device_,
        [](void*, RTCError, const char* text) {
          if (message.empty()) message = text != nullptr ? text : "unknown error";
        },
        nullptr);
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* user, ssize_t bytes, bool) {
          static_cast<Device*>(user)->bytes_ += bytes;
          return true;
        },
        this);
  }

  /// Lives as long as the process: scenes may be released while other statics are destroyed.
  static Device& get() {
    static Device& device = *new Device;
    return device;
  }

  RTCDevice device() const { return device_; }
  std::size_t bytes() const {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, bytes_));
  }

 private:
  RTCDevice device_;
  std::atomic<std::ptrdiff_t> bytes_{0};
};

}  // namespace

RTCDeviceTy* embree_device() { return Device::get().device(); }

std::size_t embree_bytes() { return Device::get().bytes(); }

void check_embree() {
  if (!message.empty()) throw Error("Embree: " + std::exchange(message, {}));
}

EmbreeScene::EmbreeScene(std::size_t count, const BoxOf& box_of, Meet meet, void* owner,
                         BuildQuality quality)
    : scene_(rtcNewScene(embree_device())) {
  RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_USER);
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
    check_embree();
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
