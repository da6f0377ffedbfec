// SPDX-License-Identifier: MIT
// Tests of a URDF's data for ros_control: transmissions and safety limits.
#include "fixture.h"

namespace ardee {
namespace {

class UrdfControl : public ReadersTest {
 protected:
  std::shared_ptr<const Model> with_transmission(const std::string& inside,
                                                 const std::string& in_joint = "") {
    return robot(
        "<link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/>"
        "<child link='b'/>" +
        in_joint + "</joint><transmission name='t'>" + inside + "</transmission>");
  }
  std::string only_error() const { return errors_->size() == 1 ? errors_->front() : ""; }
};

constexpr char kType[] = "<type>transmission_interface/SimpleTransmission</type>";
constexpr char kActuator[] =
    "<actuator name='m'><mechanicalReduction>50</mechanicalReduction></actuator>";
constexpr char kJoint[] =
    "<joint "
    "name='j'><hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></"
    "joint>";

TEST_F(UrdfControl, ReadsTransmissions) {
  const auto m = with_transmission(std::string(kType) + kJoint + kActuator);
  ASSERT_EQ(m->transmissions.size(), 1u);
  EXPECT_EQ(m->transmissions[0].name, "t");
  EXPECT_EQ(m->transmissions[0].joint, "j");
  EXPECT_EQ(m->transmissions[0].interfaces,
            std::vector<std::string>{"hardware_interface/VelocityJointInterface"});
  EXPECT_TRUE(warnings_->empty() && errors_->empty());
}

TEST_F(UrdfControl, ReadsTheBareSpelling) {
  const auto m = with_transmission(
      std::string(kType) +
      "<joint "
      "name='j'><hardwareInterface>EffortJointInterface</hardwareInterface><hardwareInterface>"
      "PositionJointInterface</hardwareInterface></joint><actuator name='m'/>");
  ASSERT_EQ(m->transmissions.size(), 1u);
  EXPECT_EQ(m->transmissions[0].interfaces,
            (std::vector<std::string>{"EffortJointInterface", "PositionJointInterface"}));
  EXPECT_TRUE(warnings_->empty() && errors_->empty());
}

TEST_F(UrdfControl, LeavesOutATransmissionThatLacksSomething) {
  const struct {
    std::string inside;
    const char* expected;
  } cases[]{
      {std::string(kJoint) + kActuator, "found no <type>"},
      {std::string("<type/>") + kJoint + kActuator, "<type>: "},
      {std::string(kType) + kActuator, "found no <joint>"},
      {std::string(kType) + kJoint, "found no <actuator>"},
      {std::string(kType) + kJoint + "<actuator/>", "'name'"},
      {std::string(kType) + "<joint name='j'/>" + kActuator, "found no <hardwareInterface>"},
      {std::string(kType) + "<joint name='j'><hardwareInterface/></joint>" + kActuator,
       "<hardwareInterface>: "},
  };
  for (const auto& each : cases) {
    errors_->clear();
    EXPECT_TRUE(with_transmission(each.inside)->transmissions.empty());
    EXPECT_NE(only_error().find(each.expected), std::string::npos)
        << only_error() << " for " << each.inside;
    EXPECT_NE(only_error().find("; transmission 't' is left out"), std::string::npos)
        << only_error();
  }
}

TEST_F(UrdfControl, LeavesOutATransmissionOfSeveralJoints) {
  EXPECT_TRUE(
      with_transmission(std::string(kType) + kJoint + kJoint + kActuator)->transmissions.empty());
  EXPECT_TRUE(warned("found several joints, expected one; transmission 't' is left out"));
}

TEST_F(UrdfControl, ReadsSafetyLimits) {
  const auto m = with_transmission(std::string(kType) + kJoint + kActuator,
                                   "<safety_controller soft_lower_limit='-1' soft_upper_limit='2' "
                                   "k_position='15' k_velocity='10'/>");
  const auto& safety = m->joints.at(0).safety;
  ASSERT_TRUE(safety);
  EXPECT_EQ(safety->soft_lower, -1.0);
  EXPECT_EQ(safety->soft_upper, 2.0);
  EXPECT_EQ(safety->k_position, 15.0);
  EXPECT_EQ(safety->k_velocity, 10.0);
}

TEST_F(UrdfControl, LeavesOutSafetyLimitsThatSayNoGain) {
  for (const char* written :
       {"<safety_controller k_position='1'/>", "<safety_controller k_velocity='x'/>"}) {
    errors_->clear();
    const auto m = with_transmission(std::string(kType) + kJoint + kActuator, written);
    EXPECT_FALSE(m->joints.at(0).safety);
    EXPECT_NE(only_error().find("; the <safety_controller> is left out"), std::string::npos)
        << only_error();
  }
}

}  // namespace
}  // namespace ardee
