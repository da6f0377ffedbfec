// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ardee_sim/raycast/ray_query.h"

namespace ardee {

/// The triangles of placed bodies as Embree takes them, in floats: several times as quick as exact
/// tests, for pictures. Which triangle is the nearest is decided in floats; the hit itself is the
/// exact one of that triangle.
class DraftScene {
 public:
  /// Coordinates are relative to `origin_W`. The bodies must outlive the scene.
  DraftScene(const EmbreeDevice& device, const std::vector<const PlacedBody*>& bodies,
             const Eigen::Vector3d& origin_W);
  ~DraftScene();

  /// Nearest hits. True for each query, in `undecided`, that the floats have led to a triangle that
  /// it does not meet.
  void meet(RayQuery queries[kPacketRays], const Passage passages[kPacketRays],
            bool undecided[kPacketRays]) const;
  /// Queries of shadows end where something is in the way.
  void meet_shadows(RayQuery queries[kPacketRays], const Passage passages[kPacketRays]) const;

  std::size_t bytes() const;

 private:
  struct Owner {
    std::uint32_t body;
    std::uint32_t triangle;  // of the body
  };
  /// Triangles that each ray meets, and those that must be looked at: with holes, without a back,
  /// without a shadow.
  struct Part {
    const DraftScene* scene = nullptr;
    std::vector<Owner> owners;
    std::vector<Eigen::Vector3f> vertices;
    std::vector<std::uint32_t> corners;  // three a triangle
  };

  void add(std::uint32_t body, const Eigen::Vector3d& origin_W);
  void attach(const EmbreeDevice& device, Part& part, bool careful);
  static void sort_out_hits(const RTCFilterFunctionNArguments* args);
  static void sort_out_shadows(const RTCFilterFunctionNArguments* args);
  template <typename Keep>
  static void filter(const RTCFilterFunctionNArguments* args, const Keep& keep);

  std::vector<const PlacedBody*> bodies_;
  Part parts_[2];  // met by all; to be looked at
  RTCSceneTy* scene_;
};

}  // namespace ardee
