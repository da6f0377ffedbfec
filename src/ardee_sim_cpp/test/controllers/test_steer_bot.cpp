// SPDX-License-Identifier: MIT
#include <cmath>

#include "ardee_sim/controllers/steer_bot.h"
#include "rig.h"

namespace ardee::control {
namespace {

constexpr double kBase_m = 0.65;
constexpr double kTrack_m = 0.6;

/// Car with four wheels and two knuckles. It has the bicycle's wheel, but no steering joint of the
/// bicycle.
class SteerBotTest : public testing::Test {
 protected:
  SteerBotTest() {
    for (const double side : {-1.0, 1.0}) {
      const std::string name = side > 0 ? "left" : "right";
      rig.add_wheel("rear_" + name, {0, side * kTrack_m / 2, 0}, Sphere{0.1});
      rig.add_wheel("front_" + name, {kBase_m, side * kTrack_m / 2, 0}, Sphere{0.1});
      rig.add_wheel("knuckle_" + name, {kBase_m, side * kTrack_m / 2, 0}, Sphere{0.1});
    }
    rig.add_wheel("rear", {0, 0, 0}, Sphere{0.1});
  }
  SteerBot make() { return {settings_of(parameters), rig.model, rig.log}; }
  Hardware follow(double wheel, double steer) {
    const SteerBot bot = make();
    Hardware hardware;
    for (const auto& [name, interface] : bot.joints()) hardware[name].interface = interface;
    hardware.at("rear").command = wheel;
    hardware.at("steer").command = steer;
    bot.follow(hardware, 0.01);
    return hardware;
  }

  Rig rig;
  Parameters parameters{{"rear_wheel", std::string("rear")},
                        {"front_steer", std::string("steer")},
                        {"virtual_rear_wheels", names({"rear_right", "rear_left"})},
                        {"virtual_front_wheels", names({"front_right", "front_left"})},
                        {"virtual_front_steers", names({"knuckle_right", "knuckle_left"})},
                        {"wheel_separation_w", kTrack_m},
                        {"wheel_separation_h", kBase_m}};
};

TEST_F(SteerBotTest, AxesOfAllWheelsMeetInOnePoint) {
  Hardware car = follow(3.0, 0.3);
  for (const char* wheel : {"rear_left", "rear_right", "front_left", "front_right"}) {
    EXPECT_EQ(car.at(wheel).command, 3.0);
    EXPECT_EQ(car.at(wheel).interface, JointInterface::kVelocity);
  }
  const double left = car.at("knuckle_left").command;
  const double right = car.at("knuckle_right").command;
  EXPECT_GT(left, right);  // the inner one
  const double radius_m = kBase_m / std::tan(0.3);
  EXPECT_NEAR(kBase_m / std::tan(left), radius_m - kTrack_m / 2, 1e-12);
  EXPECT_NEAR(kBase_m / std::tan(right), radius_m + kTrack_m / 2, 1e-12);
  EXPECT_NEAR(follow(3.0, -0.3).at("knuckle_right").command, -left, 1e-12);
  EXPECT_EQ(car.at("steer").position, 0.3);  // this joint does not exist
  EXPECT_EQ(car.at("rear").position, 0.0);   // this joint is driven
}

TEST_F(SteerBotTest, WithoutTheLinkKnucklesTurnAlike) {
  parameters["enable_ackermann_link"] = false;
  Hardware car = follow(1.0, 0.3);
  EXPECT_NEAR(car.at("knuckle_left").command, 0.3, 1e-12);
  EXPECT_NEAR(car.at("knuckle_right").command, 0.3, 1e-12);
}

TEST_F(SteerBotTest, AWheelThatTheCarHasNotRollsAndIsReset) {
  parameters["rear_wheel"] = std::string("virtual");
  const SteerBot bot = make();
  Hardware hardware;
  for (const auto& [name, interface] : bot.joints()) hardware[name].interface = interface;
  hardware.at("virtual").command = 3.0;
  hardware.at("steer").command = 0.3;
  for (int i = 0; i < 100; ++i) bot.follow(hardware, 0.01);
  EXPECT_NEAR(hardware.at("virtual").position, 3.0, 1e-12);
  EXPECT_EQ(hardware.at("virtual").velocity, 3.0);
  bot.reset(hardware);
  EXPECT_EQ(hardware.at("virtual").position, 0.0);
  EXPECT_EQ(hardware.at("virtual").command, 0.0);
  EXPECT_EQ(hardware.at("steer").position, 0.0);
}

TEST_F(SteerBotTest, SaysWhatIsWrong) {
  parameters["enable_ackermann_link"] = std::string("false");
  parameters["gains/rear_left/p"] = 1.0;
  parameters["rear_wheels"] = names({"rear_left"});
  make();
  const std::vector<std::string> said{
      "/base/gains: has no effect: joints follow at once",
      "/base/rear_wheels: found an unknown parameter, nearest: rear_wheel, ",
      "/base/enable_ackermann_link: found no truth value, expected true or false; true is taken"};
  ASSERT_EQ(rig.messages.size(), said.size());
  for (std::size_t i = 0; i < said.size(); ++i) EXPECT_EQ(rig.messages[i].find(said[i]), 0U);
  const auto why = [this] { return message_of([this] { make(); }); };
  parameters["virtual_rear_wheels"] = names({"knee"});
  EXPECT_EQ(
      why(),
      "/base/virtual_rear_wheels: found joint 'knee', expected one of the robot's description; "
      "nearest: knuckle_left, knuckle_right, front_left, rear_left, front_right, ... (7 in all)");
  parameters.erase("rear_wheel");
  EXPECT_EQ(why(), "/base/rear_wheel: found nothing, expected a text");
}

}  // namespace
}  // namespace ardee::control
