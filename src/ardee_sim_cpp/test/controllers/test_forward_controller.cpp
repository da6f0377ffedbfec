// SPDX-License-Identifier: MIT
#include "rig.h"

namespace ardee::control {
namespace {

TEST(ForwardController, HoldsAPositionAndBeginsOthersAtZero) {
  struct Case {
    JointInterface interface;
    const char* type;
    double at_start;
  };
  for (const Case& each :
       {Case{JointInterface::kPosition, "position_controllers/JointPositionController", 0.7},
        Case{JointInterface::kVelocity, "velocity_controllers/JointVelocityController", 0.0},
        Case{JointInterface::kEffort, "effort_controllers/JointEffortController", 0.0}}) {
    Rig rig;
    rig.add_joint("j", each.interface);
    rig.joint("j").position = 0.7;
    rig.joint("j").command = 9.0;
    rig.start(each.type, {{"joint", std::string("j")}});
    rig.update();
    EXPECT_EQ(rig.command_of("j"), each.at_start);
    rig.send("/base/command", -2.5);
    rig.update(1000);  // no timeout
    EXPECT_EQ(rig.command_of("j"), -2.5);
    EXPECT_EQ(rig.controller->claims().at(each.interface), std::set<std::string>{"j"});
  }
}

TEST(ForwardController, ForgetsACommandThatCameBeforeItsStart) {
  Rig rig;
  rig.add_joint("j", JointInterface::kVelocity);
  rig.make("velocity_controllers/JointVelocityController", {{"joint", std::string("j")}});
  rig.send("/base/command", 3.0);
  rig.controller->start(0);
  rig.update();
  EXPECT_EQ(rig.command_of("j"), 0.0);
}

TEST(ForwardController, CommandsAGroupInItsOrder) {
  struct Case {
    JointInterface interface;
    const char* type;
  };
  for (const Case& each :
       {Case{JointInterface::kPosition, "position_controllers/JointGroupPositionController"},
        Case{JointInterface::kVelocity, "velocity_controllers/JointGroupVelocityController"},
        Case{JointInterface::kEffort, "effort_controllers/JointGroupEffortController"}}) {
    Rig rig;
    rig.add_joint("a", each.interface);
    rig.add_joint("b", each.interface);
    rig.start(each.type, {{"joints", names({"b", "a"})}});
    rig.send("/base/command", std::vector<double>{1.0, 2.0});
    rig.update();
    EXPECT_EQ(rig.command_of("b"), 1.0);
    EXPECT_EQ(rig.command_of("a"), 2.0);
    EXPECT_EQ(message_of([&] {
                rig.send("/base/command", std::vector<double>{1.0, 2.0, 3.0});
              }),
              "found 3 numbers, expected 2, one a joint");
    EXPECT_EQ(message_of([&] {
                rig.send("/base/command", std::vector<double>{1.0, NAN});
              }),
              "found a command that is not finite");
    rig.update();
    EXPECT_EQ(rig.command_of("a"), 2.0);
  }
}

TEST(ForwardController, SaysWhichParameterIsWrong) {
  Rig rig;
  rig.add_joint("j", JointInterface::kVelocity);
  EXPECT_EQ(rig.refusal("velocity_controllers/JointVelocityController", {}),
            "/base/joint: found nothing, expected a text");
  EXPECT_EQ(rig.refusal("effort_controllers/JointEffortController", {{"joint", std::string("j")}}),
            "/base/joint: joint 'j' has the hardware_interface::VelocityJointInterface, expected "
            "the hardware_interface::EffortJointInterface");
  EXPECT_EQ(rig.refusal("velocity_controllers/JointGroupVelocityController",
                        {{"joints", std::string("j")}}),
            "/base/joints: found 'j', expected a list of names");
}

TEST(ForwardController, GoesOnFromASavedState) {
  Rig rig;
  rig.add_joint("j", JointInterface::kVelocity);
  rig.start("velocity_controllers/JointVelocityController", {{"joint", std::string("j")}});
  rig.send("/base/command", 3.0);
  rig.expect_repeats(5);
}

}  // namespace
}  // namespace ardee::control
