// SPDX-License-Identifier: MIT
#include <cmath>

#include "fixture.h"

namespace ardee {
namespace {

class SdfJointTest : public ReadersTest {
 protected:
  Joint joint(const std::string& type, const std::string& body,
              const std::string& version = "1.5") {
    // The child is turned by 90 degrees about z: its x is the model's y.
    return model(
               "<link name='a'/><link name='b'><pose>1 0 0 0 0 1.5707963267948966</pose></link>"
               "<joint name='j' type='" +
                   type + "'><parent>a</parent><child>b</child>" + body + "</joint>",
               version)
        ->joints.at(0);
  }
};

TEST_F(SdfJointTest, AxisIsInTheJointFrameSince15) {
  expect_near(joint("revolute", "<axis><xyz>2 0 0</xyz></axis>", "1.5").axis.axis, {1, 0, 0});
  expect_near(joint("revolute", "<axis><xyz>2 0 0</xyz></axis>", "1.6").axis.axis, {1, 0, 0});
}

TEST_F(SdfJointTest, AxisIsInTheModelFrameUpTo14) {
  for (const char* version : {"1.3", "1.4"}) {
    // The model's x is the child's -y.
    expect_near(joint("revolute", "<axis><xyz>1 0 0</xyz></axis>", version).axis.axis, {0, -1, 0});
  }
}

TEST_F(SdfJointTest, UseParentModelFrameDecidesWhereGiven) {
  const std::string in_model =
      "<axis><xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>";
  const std::string in_joint =
      "<axis><xyz>1 0 0</xyz><use_parent_model_frame>0</use_parent_model_frame></axis>";
  expect_near(joint("revolute", in_model, "1.6").axis.axis, {0, -1, 0});
  expect_near(joint("revolute", in_joint, "1.4").axis.axis, {1, 0, 0});
}

TEST_F(SdfJointTest, AnAxisMaySayInWhichFrameItIs) {
  const auto with = [this](const std::string& frame) {
    return joint("revolute", "<axis><xyz expressed_in='" + frame + "'>1 0 0</xyz></axis>", "1.7");
  };
  expect_near(with("__model__").axis.axis, {0, -1, 0});
  expect_near(with("").axis.axis, {1, 0, 0});
  expect_near(with("a").axis.axis, {0, -1, 0});
  expect_near(with("b").axis.axis, {1, 0, 0});
  EXPECT_HAS(error_of([&] { with("c"); }), "found frame 'c', expected one of __model__, a, b, j");
}

TEST_F(SdfJointTest, TheJointsOwnPoseTurnsAModelAxisToo) {
  // The joint is turned back by 90 degrees: its axes are the model's.
  const Joint j =
      joint("revolute", "<pose>0 0 0.5 0 0 -1.5707963267948966</pose><axis><xyz>1 0 0</xyz></axis>",
            "1.4");
  expect_near(j.axis.axis, {1, 0, 0});
  expect_near(j.X_CJ.p, {0, 0, 0.5});
}

TEST_F(SdfJointTest, ReadsAllThatActsAlongTheAxis) {
  const Joint j = joint("revolute", R"(<axis><xyz>0 0 1</xyz>
      <limit><lower>-0.5</lower><upper>0.7</upper><effort>10</effort><velocity>3</velocity></limit>
      <dynamics><damping>0.1</damping><friction>0.2</friction>
        <spring_stiffness>100</spring_stiffness><spring_reference>0.3</spring_reference></dynamics></axis>
      <physics><ode><limit><cfm>0.01</cfm><erp>0.4</erp></limit>
        <implicit_spring_damper>1</implicit_spring_damper></ode></physics>)");
  EXPECT_EQ(j.type, JointType::kRevolute);
  EXPECT_EQ(j.axis.lower, -0.5);
  EXPECT_EQ(j.axis.upper, 0.7);
  EXPECT_EQ(j.axis.effort, 10.0);
  EXPECT_EQ(j.axis.velocity, 3.0);
  EXPECT_EQ(j.axis.damping, 0.1);
  EXPECT_EQ(j.axis.friction, 0.2);
  EXPECT_EQ(j.axis.spring_stiffness, 100.0);
  EXPECT_EQ(j.axis.spring_reference, 0.3);
  EXPECT_EQ(j.stop_cfm, 0.01);
  EXPECT_EQ(j.stop_erp, 0.4);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SdfJointTest, RevoluteWithoutLimitsIsContinuous) {
  const Joint j = joint("revolute",
                        "<axis><xyz>0 0 1</xyz><limit><lower>-1e16</lower><upper>1e16</upper>"
                        "<effort>-1</effort><velocity>-1</velocity></limit></axis>");
  EXPECT_EQ(j.type, JointType::kContinuous);
  EXPECT_TRUE(std::isinf(j.axis.effort) && std::isinf(j.axis.velocity));
  EXPECT_EQ(joint("revolute", "<axis><xyz>0 0 1</xyz></axis>").type, JointType::kContinuous);
  EXPECT_EQ(joint("revolute", "<axis><xyz>0 0 1</xyz><limit><lower>0</lower></limit></axis>").type,
            JointType::kRevolute);
}

TEST_F(SdfJointTest, KnowsAllTypes) {
  const std::string axis = "<axis><xyz>0 0 1</xyz></axis>";
  const std::string axes = axis + "<axis2><xyz>0 1 0</xyz></axis2>";
  EXPECT_EQ(joint("fixed", "").type, JointType::kFixed);
  EXPECT_EQ(joint("ball", "").type, JointType::kBall);
  EXPECT_EQ(joint("prismatic", axis).type, JointType::kPrismatic);
  EXPECT_EQ(joint("universal", axes).type, JointType::kUniversal);
  expect_near(joint("revolute2", axes).axis2.axis, {0, 1, 0});
  // A pitch of 2 pi radians a metre, left-handed: one metre back in a turn.
  EXPECT_NEAR(
      joint("screw", axis + "<thread_pitch>6.283185307179586</thread_pitch>").thread_pitch_m, -1.0,
      1e-12);
  EXPECT_HAS(error_of([&] { joint("planar", axis); }), "found joint type 'planar', expected");
}

TEST_F(SdfJointTest, AGearboxCouplesTheJointsOnItsReferenceBody) {
  const auto geared = [&](const std::string& second, const std::string& reference) {
    return model(
        "<link name='f'/><link name='a'/><link name='b'/>"
        "<joint name='ja' type='revolute'><parent>f</parent><child>a</child>"
        "<axis><xyz>0 0 1</xyz></axis></joint>" +
        second +
        "<joint name='g' type='gearbox'><parent>a</parent><child>b</child>"
        "<gearbox_ratio>3</gearbox_ratio><gearbox_reference_body>" +
        reference +
        "</gearbox_reference_body><axis><xyz>0 0 1</xyz></axis>"
        "<axis2><xyz>0 0 1</xyz></axis2></joint>");
  };
  const auto second = [](const std::string& parent, const std::string& child,
                         const std::string& axis) {
    return "<joint name='jb' type='revolute'><parent>" + parent + "</parent><child>" + child +
           "</child><axis><xyz>" + axis + "</xyz></axis></joint>";
  };
  const auto m = geared(second("f", "b", "0 0 1"), "f");
  EXPECT_EQ(m->joints.size(), 2u);
  ASSERT_EQ(m->couplings.size(), 1u);
  EXPECT_EQ(m->couplings[0].leader, "ja");
  EXPECT_EQ(m->couplings[0].follower, "jb");
  EXPECT_EQ(m->couplings[0].multiplier, -3.0);
  EXPECT_EQ(m->couplings[0].offset, 0.0);
  // The joint counts the other way round, by its axis or by its links.
  EXPECT_EQ(geared(second("f", "b", "0 0 -1"), "f")->couplings.at(0).multiplier, 3.0);
  EXPECT_EQ(geared(second("b", "f", "0 0 1"), "f")->couplings.at(0).multiplier, 3.0);
  EXPECT_TRUE(geared(second("a", "b", "0 0 1"), "f")->couplings.empty());
  EXPECT_HAS(error_of([&] { geared(second("f", "b", "0 0 1"), "nobody"); }), "nobody");
}

TEST_F(SdfJointTest, AChildWorldChangesPlacesWithTheParent) {
  const auto m = model(
      "<link name='a'><pose>0 0 2 0 0 0</pose></link><joint name='j' type='revolute'>"
      "<parent>a</parent><child>world</child><axis><xyz>0 0 1</xyz></axis></joint>");
  const Joint& j = m->joints.at(0);
  EXPECT_EQ(j.parent, "world");
  EXPECT_EQ(j.child, "a");
  expect_near(j.axis.axis, {0, 0, -1});
  expect_near(j.X_CJ.p, {0, 0, -2});
}

TEST_F(SdfJointTest, MayHangOnTheWorld) {
  const auto m = model(
      "<link name='a'/><joint name='j' "
      "type='fixed'><parent>world</parent><child>a</child></joint>");
  EXPECT_EQ(m->joints.at(0).parent, "world");
}

TEST_F(SdfJointTest, TakesLinksInTheScopeOfTheirOwnModel) {
  const auto m = model(
      "<link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose></link><joint name='j' type='fixed'>"
      "<parent>m::a</parent><child>m::b</child></joint>");
  EXPECT_EQ(m->joints.at(0).parent, "a");
  EXPECT_EQ(m->joints.at(0).child, "b");
  const std::string nested = "<model name='m'><link name='a'/></model>";
  const auto of_nested = model("<link name='a'/>" + nested +
                               "<joint name='j' type='fixed'><parent>a</parent><child>m::a</child>"
                               "</joint>");
  EXPECT_EQ(of_nested->joints.at(0).child, "m::a");
  EXPECT_HAS(error_of([&] {
               model(
                   "<link name='a'/><joint name='j' type='fixed'><parent>m::x</parent>"
                   "<child>a</child></joint>");
             }),
             "found link 'x', expected one of a");
}

}  // namespace
}  // namespace ardee
