// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "fixture.h"

namespace ardee {
using namespace physics;
using namespace devices;
namespace {

constexpr double kWeight_N = 3.0 * 9.8;
constexpr double kArm_m = 0.5;

/// Returns 3 kg whose centre of mass is `com` from a joint to the world at the link's origin.
std::string hanging(const std::string& joint_type, const std::string& in_joint,
                    const std::string& com, const std::string& plugin = "") {
  return "<sdf version='1.7'><model name='scale'><link name='load'><inertial><pose>" + com +
         " 0 0 0</pose><mass>3</mass></inertial></link><joint name='hook' type='" + joint_type +
         "'><parent>world</parent><child>load</child>" + in_joint +
         "</joint><plugin name='ft' filename='libgazebo_ros_ft_sensor.so'>"
         "<jointName>hook</jointName><topicName>ft</topicName><updateRate>100</updateRate>" +
         plugin + "</plugin></model></sdf>";
}

const std::string kAxisY = "<axis><xyz>0 1 0</xyz>";
const std::string kLocked = kAxisY + "<limit><lower>0</lower><upper>0</upper></limit></axis>";
const std::string kFeedback = "<provide_feedback>true</provide_feedback>";
const std::string kMeasured = "<physics><ode>" + kFeedback + "</ode></physics>";

/// Returns the last reading of half a second.
ForceTorque reading(const std::string& xml, const Pose& pose = {}) {
  TestWorld world("");
  world.spawn(xml, "scale", pose);
  world.run(0.5);
  const auto messages = world.recorder().on<WrenchReading>("/ft");
  if (messages.size() != 50) throw Error("found other than 50 messages");
  EXPECT_EQ(messages.back().header.frame_id, "load");
  return messages.back().wrench;
}

void expect_wrench(const ForceTorque& found, const Eigen::Vector3d& force,
                   const Eigen::Vector3d& torque) {
  EXPECT_LT((found.force - force).norm(), 1e-3) << found.force.transpose();
  EXPECT_LT((found.torque - torque).norm(), 1e-3) << found.torque.transpose();
}

TEST(ForceTorque, OfAHangingMassIsItsWeight) {
  expect_wrench(reading(hanging("revolute", kAxisY + "</axis>", "0 0 -0.5")), {0, 0, -kWeight_N},
                {0, 0, 0});
}

TEST(ForceTorque, OfAnOffsetMassHasTheMomentOfItsArm) {
  // The torque is (0.5, 0, 0) x (0, 0, -m g) = (0, 0.5 m g, 0), held by the stop, and by a fixed
  // joint.
  const Eigen::Vector3d force(0, 0, -kWeight_N), torque(0, kArm_m * kWeight_N, 0);
  expect_wrench(reading(hanging("revolute", kLocked, "0.5 0 0")), force, torque);
  const std::string outside_ode = "<physics>" + kFeedback + "</physics>";
  expect_wrench(reading(hanging("fixed", kMeasured, "0.5 0 0")), force, torque);
  expect_wrench(reading(hanging("fixed", outside_ode, "0.5 0 0")), force, torque);
}

TEST(ForceTorque, IsInTheAxesOfTheChild) {
  // With a roll of a quarter turn, the world's down is the child's -y.
  const Pose rolled = Pose::from_xyz_rpy({0, 0, 0}, {M_PI / 2, 0, 0});
  expect_wrench(reading(hanging("fixed", kMeasured, "0.5 0 0"), rolled), {0, -kWeight_N, 0},
                {0, 0, -kArm_m * kWeight_N});
}

TEST(ForceTorque, HoldsWhatSpringsAndMotorsCarry) {
  // A spring holds the arm level at its reference: k x 0.1 rad = m g r.
  const double stiffness = kArm_m * kWeight_N / 0.1;
  const std::string sprung = kAxisY + "<dynamics><damping>10</damping><spring_stiffness>" +
                             std::to_string(stiffness) +
                             "</spring_stiffness><spring_reference>-0.1</spring_reference>"
                             "</dynamics></axis>";
  expect_wrench(reading(hanging("revolute", sprung, "0.5 0 0")), {0, 0, -kWeight_N},
                {0, kArm_m * kWeight_N, 0});
}

TEST(ForceTorque, HasNoiseOfTheGivenDeviation) {
  const ForceTorque plain = reading(hanging("fixed", kMeasured, "0 0 0"));
  const ForceTorque noisy =
      reading(hanging("fixed", kMeasured, "0 0 0", "<gaussianNoise>0.1</gaussianNoise>"));
  const double error = (noisy.force - plain.force).norm();
  EXPECT_GT(error, 1e-3);
  EXPECT_LT(error, 1.0);
}

TEST(ForceTorque, RefusesAFixedJointThatIsNotMeasured) {
  TestWorld world("");
  world.spawn(hanging("fixed", "", "0 0 0"), "scale");
  ASSERT_FALSE(world.messages().empty());
  EXPECT_NE(world.messages().back().find("joint 'hook' of model 'scale': found it fixed"),
            std::string::npos)
      << world.messages().back();
}

}  // namespace
}  // namespace ardee
