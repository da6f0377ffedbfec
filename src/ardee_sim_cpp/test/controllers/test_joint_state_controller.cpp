// SPDX-License-Identifier: MIT
#include "rig.h"

namespace ardee::control {
using namespace devices;
namespace {

class JointStateController : public testing::Test {
 protected:
  JointStateController() {
    rig.add_joint("b", JointInterface::kEffort);
    rig.add_joint("a", JointInterface::kVelocity);
    rig.add_joint("c", JointInterface::kPosition);
    rig.joint("b").position = 1.0;
    rig.joint("b").velocity = 2.0;
    rig.joint("b").effort = 3.0;
  }
  void start(const Parameters& parameters) {
    rig.start("joint_state_controller/JointStateController", parameters);
  }
  std::string refusal(const Parameters& parameters) {
    return rig.refusal("joint_state_controller/JointStateController", parameters);
  }
  static Setting::List extra_joint(const Setting::Value& position) {
    return {{"", Setting::Map{{"name", {"name", std::string("d")}}, {"position", {"", position}}}}};
  }
  const JointStateReading& states() { return rig.last<JointStateReading>("/joint_states"); }

  Rig rig;
};

TEST_F(JointStateController, SaysWhatAllJointsDoInTheOrderOfTheirNames) {
  start({{"publish_rate", 50}});
  rig.update();
  EXPECT_EQ(states().names, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(states().positions[1], 1.0);
  EXPECT_EQ(states().velocities[1], 2.0);
  EXPECT_EQ(states().efforts[1], 3.0);
  EXPECT_EQ(states().header.stamp_ns, rig.now_ns);
  EXPECT_TRUE(rig.controller->claims().empty());
}

TEST_F(JointStateController, PublishesInTheFirstCycleThenAtItsRate) {
  start({{"publish_rate", 20}});
  rig.update();
  EXPECT_EQ(rig.count("/joint_states"), 1u);
  rig.update(3);
  EXPECT_EQ(rig.count("/joint_states"), 1u);
  rig.update();  // 50 ms
  EXPECT_EQ(rig.count("/joint_states"), 2u);
  rig.update(95);
  EXPECT_EQ(rig.count("/joint_states"), 21u);
}

TEST_F(JointStateController, TakesSomeJointsAndAddsOthers) {
  start({{"publish_rate", 50}, {"joints", names({"b"})}, {"extra_joints", extra_joint(0.5)}});
  rig.update();
  EXPECT_EQ(states().names, (std::vector<std::string>{"b", "d"}));
  EXPECT_EQ(states().positions, (std::vector<double>{1.0, 0.5}));
  EXPECT_EQ(states().velocities, (std::vector<double>{2.0, 0.0}));
}

TEST_F(JointStateController, WarnsOfAnExtraJointThatIsThereAlready) {
  rig.add_joint("d", JointInterface::kEffort);
  start({{"publish_rate", 50}, {"extra_joints", extra_joint(0.5)}});
  ASSERT_EQ(rig.messages.size(), 1u);
  EXPECT_EQ(rig.messages[0],
            "/base/extra_joints[0]: found joint 'd', expected one that is not published yet: it is "
            "published twice");
}

TEST_F(JointStateController, SaysWhichParameterIsWrong) {
  EXPECT_EQ(refusal({}), "/base/publish_rate: found nothing, expected a number");
  EXPECT_EQ(refusal({{"publish_rate", 50}, {"joints", names({"x"})}}),
            "/base/joints: found joint 'x', expected one that a transmission names");
  EXPECT_EQ(refusal({{"publish_rate", 50}, {"extra_joints", extra_joint(1)}}),
            "/base/extra_joints[0]/position: expected a number with a point, as 0.0");
}

}  // namespace
}  // namespace ardee::control
