// SPDX-License-Identifier: MIT
#include <cmath>

#include "fixture.h"

namespace ardee {
namespace {

using Urdf = ReadersTest;

constexpr const char* kTwoLinks = "<link name='a'/><link name='b'/>";

std::string joint(const std::string& type, const std::string& more, const std::string& name = "j") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='a'/><child link='b'/>" +
         more + "</joint>";
}

TEST_F(Urdf, ReadsLinks) {
  const auto m = robot(R"(<link name='a'>
      <inertial><origin xyz='0.1 0 0' rpy='0 0 0'/><mass value='2'/>
        <inertia ixx='3' ixy='0.1' ixz='0.2' iyy='4' iyz='0.3' izz='5'/></inertial>
      <collision><origin xyz='0 0 1' rpy='0 0 1.5707963267948966'/><geometry><box size='1 2 3'/></geometry></collision>
      <collision><geometry><cylinder radius='0.5' length='2'/></geometry></collision>
      <collision name='own'><geometry><sphere radius='0.25'/></geometry></collision>
      <visual><geometry><mesh filename='package://test_data/meshes/cube_mm.stl' scale='0.001 0.001 0.002'/></geometry></visual>
    </link>)");
  const Link& link = m->links.at(0);
  EXPECT_EQ(m->name, "r");
  EXPECT_EQ(m->canonical_link, "a");
  EXPECT_EQ(link.inertial->mass_kg, 2.0);
  expect_near(link.inertial->X_LI.p, {0.1, 0, 0});
  EXPECT_EQ(link.inertial->inertia_kg_m2(2, 1), 0.3);
  ASSERT_EQ(link.collisions.size(), 3u);
  EXPECT_EQ(link.collisions[0].name, "a_collision");
  EXPECT_EQ(link.collisions[1].name, "a_collision_1");
  EXPECT_EQ(link.collisions[2].name, "own");
  expect_near(link.collisions[0].X_LC * Eigen::Vector3d(1, 0, 0), {0, 1, 1});
  EXPECT_EQ(std::get<Box>(link.collisions[0].geometry).size_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<Cylinder>(link.collisions[1].geometry).length_m, 2.0);
  EXPECT_EQ(std::get<Sphere>(link.collisions[2].geometry).radius_m, 0.25);
  const Mesh& mesh = std::get<Mesh>(link.visuals.at(0).geometry);
  EXPECT_EQ(mesh.scale, Eigen::Vector3d(0.001, 0.001, 0.002));
  EXPECT_EQ(mesh.file->parts.at(0).triangles.size(), 12u);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(Urdf, PlacesLinksByTheirJoints) {
  const auto m = robot(R"(<link name='c'/><link name='b'/><link name='a'/>
      <joint name='bc' type='fixed'><parent link='b'/><child link='c'/><origin xyz='1 0 0'/></joint>
      <joint name='ab' type='fixed'><parent link='a'/><child link='b'/><origin xyz='0 0 2' rpy='0 0 1.5707963267948966'/></joint>)");
  EXPECT_EQ(m->canonical_link, "a");
  EXPECT_EQ(m->links.at(0).name, "c");
  expect_near(m->find_link("b")->X_ML.p, {0, 0, 2});
  expect_near(m->find_link("c")->X_ML.p, {0, 1, 2});
  expect_near(m->joints.at(0).X_CJ.p, {0, 0, 0});
}

TEST_F(Urdf, KeepsMasslessLinksAndFixedJoints) {
  const auto m = robot(kTwoLinks + joint("continuous", "<axis xyz='0 2 0'/>"));
  EXPECT_EQ(m->links.size(), 2u);
  EXPECT_FALSE(m->links[0].inertial || m->links[1].inertial);
  EXPECT_EQ(m->joints.at(0).type, JointType::kContinuous);
  expect_near(m->joints.at(0).axis.axis, {0, 1, 0});
  EXPECT_TRUE(std::isinf(m->joints.at(0).axis.upper));
  EXPECT_NO_THROW(robot(kTwoLinks + joint("fixed", "<axis xyz='0 0 0'/>")));
}

TEST_F(Urdf, HoldsTheJointOfALinkWithoutInertial) {
  const std::string heavy =
      "<link name='a'><inertial><mass value='2'/>"
      "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>";
  const auto held = robot(heavy + "<link name='b'/>" + joint("continuous", ""));
  EXPECT_EQ(held->joints.at(0).type, JointType::kFixed);
  EXPECT_TRUE(warned("link 'b' by joint 'j'"));
  // A link moves with the bodies that are fixed to it, and has their mass.
  const std::string carrier =
      "<link name='b'/><link name='c'><inertial><mass value='1'/>"
      "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>"
      "<joint name='bc' type='fixed'><parent link='b'/><child link='c'/></joint>";
  const auto turning = robot(heavy + carrier + joint("continuous", ""));
  EXPECT_EQ(turning->joints.at(1).type, JointType::kContinuous);
}

TEST_F(Urdf, NothingHoldsTheChildOfAFloatingOrPlanarJoint) {
  for (const char* type : {"floating", "planar"}) {
    const auto m = robot(kTwoLinks + joint(type, "<origin xyz='0 0 1'/>"));
    EXPECT_TRUE(m->joints.empty());
    expect_near(m->find_link("b")->X_ML.p, {0, 0, 1});
  }
  EXPECT_TRUE(warned("planar joints are not supported, the child moves freely"));
}

TEST_F(Urdf, AGazeboBlockMayCloseALoopByAnSdfJoint) {
  const std::string loop =
      "<gazebo><joint name='loop' type='revolute'><parent>b</parent><child>a</child>"
      "<pose>0.1 0 0 0 0 0</pose><axis><xyz>0 1 0</xyz></axis></joint>"
      "<plugin name='p' filename='p.so'/></gazebo>";
  const auto m = robot(kTwoLinks + joint("continuous", "") + loop);
  ASSERT_EQ(m->joints.size(), 2u);
  EXPECT_EQ(m->joints[1].parent, "b");
  expect_near(m->joints[1].axis.axis, {0, 1, 0});
  expect_near(m->joints[1].X_CJ.p, {0.1, 0, 0});
  EXPECT_TRUE(warnings_->empty());
  EXPECT_HAS(error_of([&] {
               robot(kTwoLinks + joint("fixed", "") +
                     "<gazebo><joint name='k' type='fixed'><parent>a</parent><child>x</child>"
                     "</joint></gazebo>");
             }),
             "found link 'x', expected one of a, b");
}

TEST_F(Urdf, AppliesACollisionBlockToAllCollisions) {
  const auto m = robot(R"(<link name='a'>
      <collision><geometry><sphere radius='1'/></geometry></collision>
      <collision><geometry><sphere radius='2'/></geometry></collision></link>
    <gazebo reference='a'><mu2>0.4</mu2><collision><max_contacts>4</max_contacts><surface><friction>
      <ode><mu>0.3</mu></ode></friction></surface></collision></gazebo>)");
  for (const Collision& c : m->links.at(0).collisions) {
    EXPECT_EQ(c.surface.mu, 0.3);
    EXPECT_EQ(c.surface.mu2, 0.4);
    EXPECT_EQ(c.surface.max_contacts, 4);
  }
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(Urdf, ReadsJointsAndTheSpringsOfListingA25) {
  const auto m = robot(
      kTwoLinks +
      joint("revolute",
            "<axis xyz='0 -1 0'/>"
            "<limit effort='10' velocity='20' lower='-0.682' upper='0.1'/>"
            "<dynamics damping='1' friction='0.5' spring_stiffness='100' spring_reference='0.2'/>"
            "<safety_controller k_velocity='1'/>"));
  const Joint& j = m->joints.at(0);
  EXPECT_EQ(j.type, JointType::kRevolute);
  EXPECT_EQ(j.axis.lower, -0.682);
  EXPECT_EQ(j.axis.upper, 0.1);
  EXPECT_EQ(j.axis.effort, 10.0);
  EXPECT_EQ(j.axis.velocity, 20.0);
  EXPECT_EQ(j.axis.damping, 1.0);
  EXPECT_EQ(j.axis.friction, 0.5);
  EXPECT_EQ(j.axis.spring_stiffness, 100.0);
  EXPECT_EQ(j.axis.spring_reference, 0.2);
  EXPECT_EQ(
      robot(kTwoLinks + joint("prismatic", "<limit effort='1' velocity='1' lower='0' upper='1'/>"))
          ->joints[0]
          .type,
      JointType::kPrismatic);
}

TEST_F(Urdf, AGazeboBlockMayGiveItsValuesAsAttributes) {
  const auto m = robot(R"(<link name='a'>
      <collision><geometry><sphere radius='1'/></geometry></collision></link>
      <gazebo reference='a'><mu1 value="0.9"/><mu2 value=" 0.8 "></mu2><kp value='1e7'/>
        <fdir1 value='0 1 0'/><maxContacts value='3'/><turnGravityOff value='true'/></gazebo>)");
  const Surface& surface = m->links.at(0).collisions.at(0).surface;
  EXPECT_EQ(surface.mu, 0.9);
  EXPECT_EQ(surface.mu2, 0.8);
  EXPECT_EQ(surface.kp_n_per_m, 1e7);
  expect_near(surface.fdir1, {0, 1, 0});
  EXPECT_EQ(surface.max_contacts, 3);
  EXPECT_FALSE(m->links.at(0).gravity);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(Urdf, LimitsOfZeroThatExportersWriteDoNotHoldAWheel) {
  const auto m = robot(kTwoLinks + joint("continuous", "<limit effort='0' velocity='0'/>"));
  EXPECT_TRUE(std::isinf(m->joints.at(0).axis.effort));
  EXPECT_TRUE(std::isinf(m->joints.at(0).axis.velocity));
}

TEST_F(Urdf, ReadsColours) {
  const auto m = robot(R"(<material name='paint'><color rgba='0.1 0.2 0.3 0.5'/></material>
    <link name='a'>
      <visual><geometry><sphere radius='1'/></geometry><material name='paint'/></visual>
      <visual><geometry><sphere radius='1'/></geometry><material name='own'><color rgba='1 0 0 1'/>
        <texture filename='package://test_data/images/rgb.png'/></material></visual>
      <visual><geometry><sphere radius='1'/></geometry></visual>
    </link>)");
  const auto& v = m->links.at(0).visuals;
  EXPECT_TRUE(v[0].material->diffuse.isApprox(Color(0.1f, 0.2f, 0.3f, 0.5f)));
  EXPECT_TRUE(v[1].material->diffuse.isApprox(Color(1, 0, 0, 1)));
  EXPECT_HAS(v[1].material->texture_path, "images/rgb.png");
  EXPECT_FALSE(v[2].material);
}

TEST_F(Urdf, AppliesLinkBlocks) {
  const auto m = robot(R"(<link name='a'>
      <collision><geometry><sphere radius='1'/></geometry></collision>
      <collision><geometry><sphere radius='2'/></geometry></collision>
      <visual><geometry><sphere radius='1'/></geometry></visual></link>
    <gazebo reference='a'><mu1>0.7</mu1><mu2>0.6</mu2><fdir1>1 0 0</fdir1><frictionCone>false</frictionCone><kp>1e6</kp><kd>100</kd>
      <minDepth>0.001</minDepth><maxVel>0.2</maxVel><maxContacts>3</maxContacts></gazebo>
    <gazebo reference='a'><selfCollide>true</selfCollide><turnGravityOff>true</turnGravityOff>
      <dampingFactor>0.1</dampingFactor><laserRetro>5</laserRetro><material>Gazebo/Orange</material></gazebo>)");
  const Link& link = m->links.at(0);
  for (const Collision& c : link.collisions) {
    EXPECT_EQ(c.surface.mu, 0.7);
    EXPECT_EQ(c.surface.mu2, 0.6);
    EXPECT_EQ(c.surface.fdir1, Eigen::Vector3d(1, 0, 0));
    EXPECT_FALSE(c.surface.friction_cone);
    EXPECT_EQ(c.surface.kp_n_per_m, 1e6);
    EXPECT_EQ(c.surface.kd_n_s_per_m, 100.0);
    EXPECT_EQ(c.surface.min_depth_m, 0.001);
    EXPECT_EQ(c.surface.max_correcting_velocity_m_per_s, 0.2);
    EXPECT_EQ(c.surface.max_contacts, 3);
    EXPECT_EQ(c.laser_retro, 5.0);
  }
  EXPECT_TRUE(link.self_collide);
  EXPECT_FALSE(link.gravity);
  EXPECT_EQ(link.linear_decay, 0.1);
  EXPECT_EQ(link.visuals.at(0).laser_retro, 5.0);
  EXPECT_EQ(link.visuals.at(0).material->name, "Gazebo/Orange");
  EXPECT_NEAR(link.visuals.at(0).material->diffuse[1], 0.5088, 1e-6);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(Urdf, AppliesAVisualBlockToAllVisuals) {
  const auto m =
      robot(R"(<link name='a'><visual><geometry><sphere radius='1'/></geometry></visual></link>
    <gazebo reference='a'><visual><material><diffuse>0.1 0.2 0.3 1</diffuse></material>
      <transparency>0.5</transparency></visual></gazebo>)");
  const Visual& v = m->links.at(0).visuals.at(0);
  EXPECT_TRUE(v.material->diffuse.isApprox(Color(0.1f, 0.2f, 0.3f, 1)));
  EXPECT_EQ(v.transparency, 0.5);
}

TEST_F(Urdf, AppliesJointBlocks) {
  const auto m = robot(kTwoLinks + joint("continuous", "") + R"(<gazebo reference='j'>
      <stopCfm>0.01</stopCfm><stopErp>0.3</stopErp><springStiffness>50</springStiffness>
      <springReference>0.1</springReference><implicitSpringDamper>1</implicitSpringDamper>
      <provideFeedback>true</provideFeedback>
      <disableFixedJointLumping>true</disableFixedJointLumping></gazebo>)");
  const Joint& j = m->joints.at(0);
  EXPECT_EQ(j.stop_cfm, 0.01);
  EXPECT_EQ(j.stop_erp, 0.3);
  EXPECT_EQ(j.axis.spring_stiffness, 50.0);
  EXPECT_EQ(j.axis.spring_reference, 0.1);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(Urdf, KeepsSensorsOnTheirLinksAndPluginsOnTheModel) {
  const auto m = robot(kTwoLinks + joint("fixed", "") + R"(
    <gazebo reference='b'><sensor name='scan' type='gpu_ray'><update_rate>40</update_rate>
      <plugin name='p' filename='laser.so'><topicName>scan</topicName></plugin></sensor></gazebo>
    <gazebo><static>true</static><plugin name='drive' filename='drive.so'><torque>10</torque></plugin></gazebo>)");
  EXPECT_TRUE(m->find_link("a")->sensors.empty());
  const SensorDescription& s = m->find_link("b")->sensors.at(0);
  EXPECT_EQ(s.type, "gpu_ray");
  EXPECT_EQ(s.update_rate_hz, 40.0);
  EXPECT_EQ(s.plugins.at(0).element.child("topicName")->text, "scan");
  EXPECT_EQ(s.plugins.at(0).element.child("topicName")->source.line, 4);
  EXPECT_EQ(s.plugins.at(0).element.child("topicName")->source.file, "test.urdf");
  EXPECT_TRUE(m->is_static);
  EXPECT_EQ(m->plugins.at(0).filename, "drive.so");
}

TEST_F(Urdf, WarnsOfWhatItDoesNotKnow) {
  robot(
      std::string("<link name='a'><inertail/></link>") +
      "<gazebo reference='nobody'><mu1>1</mu1></gazebo><gazebo reference='a'><mu3>1</mu3></gazebo>"
      "<gazebo><plugni/></gazebo>");
  EXPECT_EQ(warnings_->size(), 4u);
  EXPECT_TRUE(warned("test.urdf:2: <inertail>: not an element of <link> in URDF"));
  EXPECT_TRUE(
      warned("found no link or joint that it refers to, expected one; it is left out: 'nobody'"));
  EXPECT_TRUE(warned("<mu3>: not an element of <gazebo> in URDF, ignored"));
  EXPECT_TRUE(warned("<plugni>: not an element of <gazebo> in URDF, ignored"));
}

TEST_F(Urdf, AMimicCouplesTwoJoints) {
  const auto massive = [](const std::string& name) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
           "iyy='1' iyz='0' izz='1'/></inertial></link>";
  };
  const auto hand = [&](const std::string& type, const std::string& mimic) {
    return robot("<link name='a'/>" + massive("b") + massive("c") + "<joint name='first' type='" +
                 type +
                 "'><parent link='a'/><child link='b'/></joint><joint name='second' "
                 "type='continuous'><parent link='a'/><child link='c'/>" +
                 mimic + "</joint>");
  };
  const auto m = hand("continuous", "<mimic joint='first' multiplier='-2' offset='0.5'/>");
  ASSERT_EQ(m->couplings.size(), 1u);
  EXPECT_EQ(m->couplings[0].leader, "first");
  EXPECT_EQ(m->couplings[0].follower, "second");
  EXPECT_EQ(m->couplings[0].multiplier, -2.0);
  EXPECT_EQ(m->couplings[0].offset, 0.5);
  EXPECT_EQ(hand("continuous", "<mimic joint='first'/>")->couplings.at(0).multiplier, 1.0);
  EXPECT_TRUE(hand("fixed", "<mimic joint='first'/>")->couplings.empty());
  EXPECT_TRUE(warned("found <mimic> of a joint that does not move"));
  for (const char* other : {"third", "second"}) {
    EXPECT_HAS(error_of([&] { hand("continuous", "<mimic joint='" + std::string(other) + "'/>"); }),
               "found <mimic> of joint '" + std::string(other) + "', expected another joint");
  }
}

TEST_F(Urdf, TheFirstLinkBelowTheWorldStandsForTheRobot) {
  const auto m = robot(
      "<link name='hand'/><link name='base'/><link name='world'><visual><geometry><sphere "
      "radius='1'/></geometry></visual></link>"
      "<joint name='a' type='fixed'><parent link='world'/><child link='base'/></joint>"
      "<joint name='b' type='fixed'><parent link='base'/><child link='hand'/></joint>");
  EXPECT_EQ(m->canonical_link, "base");
  EXPECT_EQ(m->links.size(), 2u);
  EXPECT_TRUE(warned("found visuals or collisions of the link 'world'"));
}

TEST_F(Urdf, AnEmptyBlockIsAsOneThatIsNotThere) {
  const auto m = robot(
      "<link name='a'/><link name='b'/><joint name='j' type='continuous'><parent link='a'/>"
      "<child link='b'/><axis xyz='0 0 1'/></joint><gazebo "
      "reference='j'><stopCfm/><stopErp></stopErp>"
      "<springStiffness/><springReference/></gazebo><gazebo reference='b'><gravity/><selfCollide/>"
      "<turnGravityOff/><kinematic/><dampingFactor/><laserRetro/><material/></gazebo>"
      "<gazebo><static/><selfCollide/></gazebo>");
  EXPECT_TRUE(m->find_link("b")->gravity);
  EXPECT_FALSE(m->is_static || m->self_collide || m->find_link("b")->self_collide);
  EXPECT_EQ(m->joints.at(0).stop_cfm, -1.0);
  EXPECT_EQ(m->joints.at(0).axis.spring_stiffness, 0.0);
}

TEST_F(Urdf, ARootLinkCalledWorldIsTheWorld) {
  const auto m = robot(
      "<link name='world'/><link name='a'/><joint name='j' type='fixed'>"
      "<parent link='world'/><child link='a'/><origin xyz='0 0 1'/></joint>");
  ASSERT_EQ(m->links.size(), 1u);
  EXPECT_EQ(m->canonical_link, "a");
  EXPECT_EQ(m->joints.at(0).parent, "world");
  EXPECT_EQ(m->links.at(0).X_ML.p.z(), 1.0);
}

TEST_F(Urdf, WarnsOfSurfaceValuesOfALinkWithoutACollision) {
  const std::string link = "<link name='l'/><gazebo reference='l'><mu1>";
  robot(link + "0.5</mu1></gazebo>");
  ASSERT_EQ(warnings_->size(), 1u);
  EXPECT_TRUE(warned("<mu1>: has no effect: the link has no collision"));
  EXPECT_HAS(error_of([&] { robot(link + "abc</mu1></gazebo>"); }), "<mu1>: found 'abc'");
}

TEST_F(Urdf, WarnsOfASensorTypeThatIsNone) {
  robot("<link name='l'/><gazebo reference='l'><sensor name='s' type='imuu'/></gazebo>");
  EXPECT_TRUE(warned("<sensor>: found type 'imuu', expected one of: imu, "));
}

}  // namespace
}  // namespace ardee
