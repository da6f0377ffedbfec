// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/readers/loader.h"
#include "ros/joint_efforts.h"

namespace ardee::node {
namespace {

constexpr double kStep_s = 0.001;
constexpr double kInertia_kg_m2 = 0.5;
constexpr TimeNs kMillisecond_ns = 1000000;

/// A head that turns about a fixed post without friction.
struct Turret {
  Turret()
      : loader(ResourceLocator::from_environment(), Log()),
        simulation(
            loader.load_world_text(
                "<sdf version='1.6'><world name='w'><model name='turret'>"
                "<link name='foot'/><link name='head'><inertial><mass>1</mass><inertia>"
                "<ixx>0.5</ixx><iyy>0.5</iyy><izz>0.5</izz></inertia></inertial></link>"
                "<joint name='ground' type='fixed'><parent>world</parent><child>foot</child>"
                "</joint><joint name='pan' type='revolute'><parent>foot</parent>"
                "<child>head</child><axis><xyz>0 0 1</xyz></axis></joint></model></world></sdf>",
                "turret.world"),
            SimulationOptions{}, [](LogLevel, const std::string&) {}) {}

  JointEffort effort(double n_m, int from_ms, int for_ms) const {
    return {"turret", 1, n_m, from_ms * kMillisecond_ns, for_ms * kMillisecond_ns};
  }
  void run(int steps) {
    for (int step = 0; step < steps; ++step) {
      efforts.apply(simulation);
      simulation.step();
    }
  }
  double speed_rad_per_s() {
    return simulation.find("turret")->robot->dynamics().joint_velocity(1);
  }

  Loader loader;
  Simulation simulation;
  JointEfforts efforts;
};

TEST(JointEfforts, AddUpEachForItsTime) {
  Turret turret;
  turret.efforts.add(turret.effort(1.0, 0, 10));
  turret.efforts.add(turret.effort(2.0, 5, 20));
  turret.run(50);
  const double angular_momentum = (1.0 * 10 + 2.0 * 20) * kStep_s;
  EXPECT_NEAR(turret.speed_rad_per_s(), angular_momentum / kInertia_kg_m2, 1e-6);
}

TEST(JointEfforts, OfNegativeDurationLastUntilTheyAreCleared) {
  Turret turret;
  turret.efforts.add(turret.effort(1.0, 0, -1));
  turret.run(20);
  turret.efforts.clear("another", 1);
  turret.efforts.clear("turret", 0);
  turret.run(20);
  EXPECT_NEAR(turret.speed_rad_per_s(), 40 * kStep_s / kInertia_kg_m2, 1e-6);
  turret.efforts.clear("turret", 1);
  turret.run(20);
  EXPECT_NEAR(turret.speed_rad_per_s(), 40 * kStep_s / kInertia_kg_m2, 1e-6);
}

TEST(JointEfforts, OfAModelThatHasGoneAreHarmless) {
  Turret turret;
  turret.efforts.add(turret.effort(1.0, 0, -1));
  turret.simulation.remove("turret");
  turret.run(2);
  EXPECT_EQ(turret.simulation.step_count(), 2u);
}

}  // namespace
}  // namespace ardee::node
