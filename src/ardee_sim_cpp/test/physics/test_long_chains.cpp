// SPDX-License-Identifier: MIT
// Tests that models of very many links are made quickly or refused.
#include <gtest/gtest.h>

#include <ctime>

#include "models.h"

namespace ardee::test {
using namespace physics;
namespace {

constexpr int kLinks = 20'000;
/// Limit of this process's time: ten times the need of a slow machine. Work that grows with the
/// square takes far longer.
constexpr double kAtOnce_s = 10.0;

/// Returns boxes a centimetre apart, each on a joint to the one before.
std::shared_ptr<Model> chain(JointType type, bool self_collide) {
  const std::shared_ptr<Model> one = box_model(1.0, {0.1, 0.1, 0.1});
  auto made = std::make_shared<Model>(*one);
  made->self_collide = self_collide;
  made->links.clear();
  for (int i = 0; i < kLinks; ++i) {
    Link link = one->links.front();
    link.name = "l" + std::to_string(i);
    link.X_ML.p.x() = 0.01 * i;
    made->links.push_back(link);
    if (i == 0) continue;
    Joint joint;
    joint.name = "j" + std::to_string(i);
    joint.type = type;
    joint.parent = "l" + std::to_string(i - 1);
    joint.child = link.name;
    made->joints.push_back(joint);
  }
  made->canonical_link = "l0";
  return made;
}

double seconds_since(std::clock_t start) {
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double seconds_to_add(PhysicsWorld& world, const std::shared_ptr<Model>& model) {
  const std::clock_t start = std::clock();
  world.add_model(model, Pose{});
  return seconds_since(start);
}

TEST(LongChains, OfFixedJointsAreOneBodyAtOnce) {
  PhysicsWorld world(params(0.001), silent());
  EXPECT_LT(seconds_to_add(world, chain(JointType::kFixed, true)), kAtOnce_s);
}

TEST(LongChains, OfJointsThatTurnAreMadeAtOnce) {
  PhysicsWorld world(params(0.001), silent());
  EXPECT_LT(seconds_to_add(world, chain(JointType::kContinuous, false)), kAtOnce_s);
}

TEST(LongChains, WhoseLinksAllMayTouchEachOtherAreRefused) {
  PhysicsWorld world(params(0.001), silent());
  const std::clock_t start = std::clock();
  EXPECT_THROW(world.add_model(chain(JointType::kContinuous, true), Pose{}), Error);
  EXPECT_LT(seconds_since(start), kAtOnce_s);
}

}  // namespace
}  // namespace ardee::test
