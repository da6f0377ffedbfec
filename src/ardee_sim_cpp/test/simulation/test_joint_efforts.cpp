// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fixture.h"

namespace ardee {
using namespace devices;
namespace {

constexpr double kStep_s = 0.001;
constexpr double kInertia_kg_m2 = 0.5;
constexpr TimeNs kMillisecond_ns = 1000000;

/// Head that turns about a fixed post without friction.
struct Turret {
  JointEffort effort(double n_m, int from_ms, int for_ms) {
    return {world->find("turret")->robot.get(), 1, n_m, from_ms * kMillisecond_ns,
            for_ms * kMillisecond_ns};
  }
  TimedCommands<JointEffort>& efforts() { return world->joint_efforts(); }
  Robot& robot() { return *world->find("turret")->robot; }
  void run(int steps) { world.run(steps * kStep_s); }
  double speed_rad_per_s() { return robot().dynamics().joint_velocity(1); }

  TestWorld world{
      "<model name='turret'><link name='foot'/><link name='head'><inertial><mass>1</mass><inertia>"
      "<ixx>0.5</ixx><iyy>0.5</iyy><izz>0.5</izz></inertia></inertial></link>"
      "<joint name='ground' type='fixed'><parent>world</parent><child>foot</child></joint>"
      "<joint name='pan' type='revolute'><parent>foot</parent><child>head</child>"
      "<axis><xyz>0 0 1</xyz></axis></joint></model>"};
};

TEST(JointEfforts, AddUpEachForItsTime) {
  Turret turret;
  turret.efforts().add(turret.effort(1.0, 0, 10));
  turret.efforts().add(turret.effort(2.0, 5, 20));
  turret.run(50);
  const double angular_momentum = (1.0 * 10 + 2.0 * 20) * kStep_s;
  EXPECT_NEAR(turret.speed_rad_per_s(), angular_momentum / kInertia_kg_m2, 1e-6);
}

TEST(JointEfforts, OfNegativeDurationLastUntilTheyAreCleared) {
  Turret turret;
  turret.efforts().add(turret.effort(1.0, 0, -1));
  turret.run(20);
  const Robot other("other", nullptr, 0);
  turret.efforts().clear(other, 1);
  turret.efforts().clear(turret.robot(), 0);
  turret.run(20);
  EXPECT_NEAR(turret.speed_rad_per_s(), 40 * kStep_s / kInertia_kg_m2, 1e-6);
  turret.efforts().clear(turret.robot(), 1);
  turret.run(20);
  EXPECT_NEAR(turret.speed_rad_per_s(), 40 * kStep_s / kInertia_kg_m2, 1e-6);
}

TEST(JointEfforts, GoWithTheModelAndWithAReset) {
  Turret turret;
  turret.efforts().add(turret.effort(1.0, 0, -1));
  turret.world->reset_world();
  turret.run(5);
  EXPECT_EQ(turret.speed_rad_per_s(), 0.0);
  turret.efforts().add(turret.effort(1.0, 0, -1));
  turret.world->remove("turret");
  turret.run(2);
  EXPECT_EQ(turret.world->step_count(), 7u);
}

TEST(JointEfforts, OfAModelThatIsPutBackEnd) {
  Turret turret;
  turret.efforts().add(turret.effort(1e9, 0, -1));
  turret.run(1000);
  EXPECT_EQ(turret.world.messages().size(), 1u);
  EXPECT_EQ(turret.speed_rad_per_s(), 0.0);
}

}  // namespace
}  // namespace ardee
