// SPDX-License-Identifier: MIT
// Tests that meaningful input is accepted even if it deviates from the specifications.
#include <cmath>

#include "fixture.h"

namespace ardee {
namespace {

using Accepted = ReadersTest;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Texts = std::vector<std::pair<std::string, std::string>>;

const std::string kBall = "<geometry><sphere><radius>1</radius></sphere></geometry>";

std::string collision(const std::string& surface) {
  return "<link name='a'><collision name='c'>" + kBall + "<surface>" + surface +
         "</surface></collision></link>";
}

std::string urdf_link(const std::string& name, const std::string& more = "") {
  return "<link name='" + name + "'><collision><geometry><sphere radius='1'/></geometry>" +
         "</collision>" + more + "</link>";
}

TEST_F(Accepted, FrictionAndStiffnessMayBeInfinite) {
  for (const std::string infinite : {"Inf", "inf", "+INF", "infinity"}) {
    const auto m = model(collision("<friction><ode><mu>" + infinite +
                                   "</mu><mu2>1e30</mu2></ode>"
                                   "</friction><contact><ode><kp>1e30</kp><kd>" +
                                   infinite + "</kd></ode></contact>"));
    const Surface& surface = m->links.at(0).collisions.at(0).surface;
    EXPECT_EQ(surface.mu, kInfinity);
    EXPECT_EQ(surface.mu2, 1e30);
    EXPECT_EQ(surface.kp_n_per_m, 1e30);
    EXPECT_EQ(surface.kd_n_s_per_m, kInfinity);
  }
  const auto m = robot(urdf_link("a") +
                       "<gazebo reference='a'><mu1>Inf</mu1><mu2>1e30</mu2><kp>1e30</kp></gazebo>");
  EXPECT_EQ(m->links.at(0).collisions.at(0).surface.mu, kInfinity);
  EXPECT_EQ(m->links.at(0).collisions.at(0).surface.mu2, 1e30);
  EXPECT_EQ(m->links.at(0).collisions.at(0).surface.kp_n_per_m, 1e30);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(Accepted, WhatCannotBeInfiniteOrNoNumberIsRefused) {
  EXPECT_HAS(error_of([&] { model(collision("<friction><ode><mu>nan</mu></ode></friction>")); }),
             "<mu>: found 'nan', expected");
  EXPECT_HAS(error_of([&] { model("<link name='a'><pose>inf 0 0 0 0 0</pose></link>"); }),
             "expected six finite numbers");
  EXPECT_HAS(
      error_of([&] { robot("<link name='a'><inertial><mass value='inf'/></inertial></link>"); }),
      "<mass>: found value='inf', expected 1 number in [-1e+09, 1e+09]");
}

TEST_F(Accepted, NegativeFrictionIsInfinite) {
  const auto m = model(collision("<friction><ode><mu>-1</mu><mu2/></ode></friction>"));
  EXPECT_EQ(m->links.at(0).collisions.at(0).surface.mu, kInfinity);
  EXPECT_EQ(m->links.at(0).collisions.at(0).surface.mu2, 1.0);
  const auto r = robot(urdf_link("a") + "<gazebo reference='a'><mu2>-1</mu2></gazebo>");
  EXPECT_EQ(r->links.at(0).collisions.at(0).surface.mu2, kInfinity);
}

TEST_F(Accepted, LimitsOfARobotThatAreSwappedChangePlaces) {
  const auto r = robot(
      "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/>"
      "<child link='b'/><limit lower='1' upper='-1' effort='1' velocity='1'/></joint>");
  EXPECT_EQ(r->joints.at(0).axis.lower, -1.0);
  EXPECT_EQ(r->joints.at(0).axis.upper, 1.0);
  EXPECT_TRUE(warned("<limit>: found a lower limit above the upper; they change places"));
}

TEST_F(Accepted, AMovingLinkOfNoMassIsHeld) {
  const auto r = robot(
      "<link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='1'/></inertial></link><link name='b'><inertial><mass value='0'/><inertia ixx='0' "
      "ixy='0' ixz='0' iyy='0' iyz='0' izz='0'/></inertial></link><joint name='j' "
      "type='continuous'><parent link='a'/><child link='b'/></joint>");
  EXPECT_EQ(r->joints.at(0).type, JointType::kFixed);
  EXPECT_TRUE(warned("found no mass on a link that moves, expected one; it is held"));
}

TEST_F(Accepted, AnEmptyMaterialIsNone) {
  EXPECT_NO_THROW(robot(urdf_link("a") + "<gazebo reference='a'><material/></gazebo>"));
}

TEST_F(Accepted, AnEmptyElementIsItsDefault) {
  const auto m = model(
      "<static/><link name='a'><gravity></gravity><pose/><inertial><mass/></inertial>"
      "<collision name='c'>" +
      kBall +
      "<max_contacts/><surface><friction><ode><mu> </mu><fdir1/>"
      "</ode></friction></surface></collision></link>");
  const Link& link = m->links.at(0);
  EXPECT_TRUE(link.gravity);
  EXPECT_EQ(link.inertial->mass_kg, 1.0);
  EXPECT_EQ(link.collisions.at(0).surface.mu, 1.0);
  EXPECT_EQ(link.collisions.at(0).surface.max_contacts, 10);
  EXPECT_FALSE(m->is_static);
  const auto r = robot(urdf_link("a") + "<gazebo reference='a'><mu1></mu1><kp/></gazebo>");
  EXPECT_EQ(r->links.at(0).collisions.at(0).surface.mu, 1.0);
}

TEST_F(Accepted, AColourOfThreeNumbersIsOpaque) {
  const auto m = robot(
      "<link name='a'><visual><geometry><sphere radius='1'/></geometry>"
      "<material name='m'><color rgba='0.1 0.2 0.3'/></material></visual></link>");
  EXPECT_TRUE(m->links.at(0).visuals.at(0).material->diffuse.isApprox(Color(0.1f, 0.2f, 0.3f, 1)));
  const auto s = model("<link name='a'><visual name='v'>" + kBall +
                       "<material><diffuse>0.1 0.2 0.3</diffuse></material></visual></link>");
  EXPECT_TRUE(s->links.at(0).visuals.at(0).material->diffuse.isApprox(Color(0.1f, 0.2f, 0.3f, 1)));
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(Accepted, NumbersMayBeSpacedByAnythingAndHaveAFloatsSuffix) {
  const auto m = model("<link name='a'><pose>\n1\t2.5f \r\n 0\n 0 0 0\n</pose></link>");
  expect_near(m->links.at(0).X_ML.p, {1, 2.5, 0});
  const auto r = robot(
      "<link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/>"
      "<child link='b'/><origin xyz=' 1\t2.5f\n0 ' rpy=''/></joint>");
  expect_near(r->links.at(1).X_ML.p, {1, 2.5, 0});
  const auto c = model("<link name='a'><pose><![CDATA[1 2 3 0 0 0]]></pose></link>");
  expect_near(c->links.at(0).X_ML.p, {1, 2, 3});
}

TEST_F(Accepted, ABodyWithoutAShapeIsLeftOutWithOneWarning) {
  const auto m = model(
      "<link name='a'><visual name='v'/><visual name='w'><geometry/></visual>"
      "<collision name='c'/><visual name='x'>" +
      kBall + "</visual></link>");
  EXPECT_EQ(m->links.at(0).visuals.size(), 1u);
  EXPECT_TRUE(m->links.at(0).collisions.empty());
  EXPECT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(
      warned("test.sdf:1: <visual>: found no shape in it, expected a <geometry>; left out "
             "(and 1 more)"));
  warnings_->clear();
  const auto r = robot("<link name='a'><visual/><collision><geometry/></collision></link>");
  EXPECT_TRUE(r->links.at(0).visuals.empty() && r->links.at(0).collisions.empty());
  EXPECT_TRUE(warned("test.urdf:2: <collision>: found no shape in it"));
}

TEST_F(Accepted, AnAxisThatIsNotWrittenIsTheDefault) {
  const std::string links = "<link name='a'/><link name='b'/>";
  const auto sdf = [&](const std::string& axis) {
    return model(links + "<joint name='j' type='revolute'><parent>a</parent><child>b</child>" +
                 axis + "</joint>")
        ->joints.at(0);
  };
  const Joint limited = sdf("<axis><limit><lower>-1</lower><upper>1</upper></limit></axis>");
  expect_near(limited.axis.axis, {0, 0, 1});
  EXPECT_EQ(limited.axis.upper, 1.0);
  EXPECT_EQ(limited.type, JointType::kRevolute);
  EXPECT_TRUE(warnings_->empty());
  const Joint free = sdf("");
  expect_near(free.axis.axis, {0, 0, 1});
  EXPECT_EQ(free.type, JointType::kContinuous);
  ASSERT_EQ(warnings_->size(), 1u);
  EXPECT_EQ(warnings_->at(0), "test.sdf:1: <joint>: found no <axis>, expected one; it is 0 0 1");
  const auto urdf = [&](const std::string& axis) {
    return robot(links + "<joint name='j' type='continuous'><parent link='a'/><child link='b'/>" +
                 axis + "</joint>")
        ->joints.at(0);
  };
  expect_near(urdf("").axis.axis, {1, 0, 0});
  expect_near(urdf("<axis/>").axis.axis, {1, 0, 0});
}

TEST_F(Accepted, LimitsOfAUrdfMayBeInfinite) {
  const Joint j =
      robot(
          "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent link='a'/>"
          "<child link='b'/><limit lower='-inf' upper='inf' effort='inf' velocity='1e20'/></joint>")
          ->joints.at(0);
  EXPECT_EQ(j.axis.lower, -kInfinity);
  EXPECT_EQ(j.axis.upper, kInfinity);
  EXPECT_EQ(j.axis.effort, kInfinity);
}

TEST_F(Accepted, WhatNeverMovesMayHaveAnInertiaThatIsNoNumber) {
  const std::string inertial =
      "<inertial><mass>nan</mass><inertia><ixx>nan</ixx><iyy>NaN</iyy></inertia></inertial>";
  EXPECT_TRUE(model("<static>1</static><link name='a'>" + inertial + "</link>")->is_static);
  EXPECT_HAS(error_of([&] { model("<link name='a'>" + inertial + "</link>"); }), "found mass nan");
  const std::string urdf =
      "<link name='a'><inertial><mass value='1'/>"
      "<inertia ixx='nan' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
  EXPECT_TRUE(robot(urdf + "<gazebo><static>true</static></gazebo>")->is_static);
  EXPECT_HAS(error_of([&] { robot(urdf); }), "found an inertia of link 'a'");
}

TEST_F(Accepted, AllThatGazeboKnowsInABlockActsIsWarnedOfOrRefused) {
  const std::string parts =
      urdf_link("a", "<visual><geometry><sphere radius='1'/></geometry></visual>") +
      urdf_link("b") +
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>";
  const auto with = [&](const std::string& reference, const std::string& block) {
    warnings_->clear();
    const std::string where = reference.empty() ? "" : " reference='" + reference + "'";
    return robot(parts + "<gazebo" + where + ">" + block + "</gazebo>");
  };
  // These are the elements that sdformat's parser of URDF looks for, each with a value that is not
  // its default.
  for (const auto& [name, text] : Texts{{"mu1", "0.5"},
                                        {"mu2", "0.5"},
                                        {"kp", "1e5"},
                                        {"kd", "5"},
                                        {"maxVel", "0.5"},
                                        {"minDepth", "0.002"},
                                        {"maxContacts", "3"},
                                        {"fdir1", "1 0 0"},
                                        {"laserRetro", "7"},
                                        {"selfCollide", "true"},
                                        {"dampingFactor", "0.1"},
                                        {"turnGravityOff", "true"},
                                        {"gravity", "0"},
                                        {"material", "Gazebo/Red"}}) {
    const Link link = with("a", "<" + name + ">" + text + "</" + name + ">")->links.at(0);
    const Link plain = robot(parts)->links.at(0);
    const Surface& s = link.collisions.at(0).surface;
    const Surface& p = plain.collisions.at(0).surface;
    const bool acts = s.mu != p.mu || s.mu2 != p.mu2 || s.kp_n_per_m != p.kp_n_per_m ||
                      s.kd_n_s_per_m != p.kd_n_s_per_m || s.min_depth_m != p.min_depth_m ||
                      s.max_correcting_velocity_m_per_s != p.max_correcting_velocity_m_per_s ||
                      s.max_contacts != p.max_contacts || s.fdir1 != p.fdir1 || link.self_collide ||
                      link.collisions.at(0).laser_retro != 0.0 || link.linear_decay != 0.0 ||
                      !link.gravity || link.visuals.at(0).material.has_value();
    EXPECT_TRUE(acts) << name;
    EXPECT_TRUE(warnings_->empty()) << name;
  }
  for (const auto& [name, text] : Texts{{"stopCfm", "0.1"},
                                        {"stopErp", "0.1"},
                                        {"springStiffness", "5"},
                                        {"springReference", "0.5"}}) {
    const Joint j = with("j", "<" + name + ">" + text + "</" + name + ">")->joints.at(0);
    EXPECT_TRUE(j.stop_cfm == 0.1 || j.stop_erp == 0.1 || j.axis.spring_stiffness == 5.0 ||
                j.axis.spring_reference == 0.5)
        << name;
    EXPECT_TRUE(warnings_->empty()) << name;
  }
  EXPECT_EQ(with("j", "<physics><ode><limit><cfm>0.2</cfm></limit></ode></physics>")
                ->joints.at(0)
                .stop_cfm,
            0.2);
  for (const char* always : {"provideFeedback", "implicitSpringDamper", "cfmDamping",
                             "disableFixedJointLumping", "preserveFixedJoint"}) {
    with("j", "<" + std::string(always) + ">true</" + always + ">");
    EXPECT_TRUE(warnings_->empty()) << always;
  }
  EXPECT_TRUE(with("j", "<provideFeedback>1</provideFeedback>")->joints.at(0).is_measured);
  EXPECT_FALSE(with("j", "<provideFeedback>0</provideFeedback>")->joints.at(0).is_measured);
  with("j", "<fudgeFactor>0.5</fudgeFactor>");
  EXPECT_EQ(warnings_->size(), 1u);
  with("j", "<initialJointPosition>0.5</initialJointPosition>");
  EXPECT_EQ(warnings_->size(), 1u);
  with("", "<canonicalBody>a</canonicalBody>");
  EXPECT_EQ(warnings_->size(), 1u);
  EXPECT_TRUE(with("", "<static>true</static>")->is_static);
  EXPECT_HAS(error_of([&] { with("a", "<mu1>slippery</mu1>"); }), "<mu1>: found 'slippery'");
}

TEST_F(Accepted, AMaterialThatIsNotDefinedIsOneWarning) {
  const std::string visual =
      "<visual><geometry><sphere radius='1'/></geometry><material name='none'/></visual>";
  EXPECT_FALSE(
      robot("<link name='a'>" + visual + visual + "</link>")->links.at(0).visuals.at(0).material);
  ASSERT_EQ(warnings_->size(), 1u);
  EXPECT_HAS(warnings_->at(0), "(and 1 more)");
  EXPECT_HAS(error_of([&] {
               robot(
                   "<material name='m'><color rgba='1 1 1 1'/></material>"
                   "<material name='m'><color rgba='0 0 0 1'/></material><link name='a'/>");
             }),
             "found a second material 'm', expected unique names");
}

TEST_F(Accepted, PartsOfAUrdfWithoutEffectAreOneWarningEach) {
  robot(
      "<link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/>"
      "<child link='b'/><calibration rising='0'/><hardwareInterface>x</hardwareInterface></joint>");
  EXPECT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<calibration>:") && warned("<hardwareInterface>:"));
}

}  // namespace
}  // namespace ardee
