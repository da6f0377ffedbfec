// SPDX-License-Identifier: MIT
#include "fixture.h"

namespace ardee {
namespace {

using SdfLink = ReadersTest;

TEST_F(SdfLink, HasSdfDefaults) {
  const auto m = model("<link name='a'/>");
  const Link& link = m->links.at(0);
  ASSERT_TRUE(link.inertial);
  EXPECT_EQ(link.inertial->mass_kg, 1.0);
  EXPECT_TRUE(link.inertial->inertia_kg_m2.isIdentity());
  EXPECT_TRUE(link.gravity);
  EXPECT_FALSE(link.kinematic || link.self_collide || m->is_static);
  EXPECT_TRUE(m->allow_auto_disable);
  EXPECT_EQ(m->canonical_link, "a");
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SdfLink, ReadsItsOwnValues) {
  const auto m = model(R"(
      <pose>1 2 3 0 0 0</pose><static>0</static><self_collide>1</self_collide>
      <allow_auto_disable>0</allow_auto_disable>
      <link name='a'>
        <pose>0 0 0.5 0 0 1.5707963267948966</pose>
        <gravity>0</gravity><kinematic>true</kinematic>
        <velocity_decay><linear>0.1</linear><angular>0.2</angular></velocity_decay>
        <inertial><pose>0.1 0 0 0 0 0</pose><mass>2.5</mass>
          <inertia><ixx>3</ixx><ixy>0.1</ixy><ixz>0.2</ixz><iyy>4</iyy><iyz>0.3</iyz><izz>5</izz></inertia>
        </inertial>
      </link>)");
  const Link& link = m->links.at(0);
  expect_near(m->own_pose.p, {1, 2, 3});
  expect_near(link.X_ML * Eigen::Vector3d(1, 0, 0), {0, 1, 0.5});
  EXPECT_FALSE(link.gravity);
  EXPECT_TRUE(link.kinematic && link.self_collide && m->self_collide);
  EXPECT_FALSE(m->allow_auto_disable);
  EXPECT_EQ(link.linear_decay, 0.1);
  EXPECT_EQ(link.angular_decay, 0.2);
  EXPECT_EQ(link.inertial->mass_kg, 2.5);
  expect_near(link.inertial->X_LI.p, {0.1, 0, 0});
  Eigen::Matrix3d inertia;
  inertia << 3, 0.1, 0.2, 0.1, 4, 0.3, 0.2, 0.3, 5;
  EXPECT_TRUE(link.inertial->inertia_kg_m2.isApprox(inertia));
}

TEST_F(SdfLink, ReadsSurfaces) {
  const auto m = model(R"(<link name='a'><collision name='c'>
      <pose>0 0 1 0 0 0</pose><max_contacts>4</max_contacts><laser_retro>7</laser_retro>
      <geometry><box><size>1 2 3</size></box></geometry>
      <surface>
        <friction><ode><mu>0.7</mu><mu2>0.6</mu2><fdir1>0 1 0</fdir1><slip1>0.1</slip1><slip2>0.2</slip2></ode></friction>
        <contact><ode><kp>1e5</kp><kd>1e4</kd><max_vel>0.5</max_vel><min_depth>0.002</min_depth></ode>
          <collide_bitmask>0x0a</collide_bitmask><category_bitmask>3</category_bitmask></contact>
        <bounce><restitution_coefficient>0.9</restitution_coefficient><threshold>2</threshold></bounce>
      </surface></collision></link>)");
  const Collision& c = m->links.at(0).collisions.at(0);
  const Surface& s = c.surface;
  EXPECT_EQ(std::get<Box>(c.geometry).size_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(c.X_LC.p.z(), 1.0);
  EXPECT_EQ(c.laser_retro, 7.0);
  EXPECT_EQ(s.max_contacts, 4);
  EXPECT_EQ(s.mu, 0.7);
  EXPECT_EQ(s.mu2, 0.6);
  EXPECT_EQ(s.fdir1, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(s.slip1, 0.1);
  EXPECT_EQ(s.slip2, 0.2);
  EXPECT_EQ(s.kp_n_per_m, 1e5);
  EXPECT_EQ(s.kd_n_s_per_m, 1e4);
  EXPECT_EQ(s.max_correcting_velocity_m_per_s, 0.5);
  EXPECT_EQ(s.min_depth_m, 0.002);
  EXPECT_EQ(s.collide_bitmask, 10u);
  EXPECT_EQ(s.category_bitmask, 3u);
  EXPECT_EQ(s.restitution, 0.9);
  EXPECT_EQ(s.bounce_threshold_m_per_s, 2.0);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SdfLink, ReadsMasksInDecimalAndHexadecimalAndNothingElse) {
  const auto surface = [this](const std::string& mask) {
    return model(
               "<link name='a'><collision name='c'><geometry><sphere><radius>1</radius></sphere>"
               "</geometry><surface><contact><collide_bitmask>" +
               mask + "</collide_bitmask></contact></surface></collision></link>")
        ->links.at(0)
        .collisions.at(0)
        .surface;
  };
  EXPECT_EQ(surface("0xFFFF").collide_bitmask, 0xFFFFu);
  EXPECT_EQ(surface("0x02").category_bitmask, 2u) << "as the mask, unless it is given";
  EXPECT_EQ(surface("12").collide_bitmask, 12u);
  for (const std::string bad : {"-1", "0x", "x", "1.5", "0x100000000", "12 3"}) {
    EXPECT_HAS(error_of([&] { surface(bad); }),
               "<collide_bitmask>: found '" + bad + "', expected a whole number of 32 bits");
  }
}

TEST_F(SdfLink, ReadsShapes) {
  const auto m = model(R"(<link name='a'>
      <visual name='1'><geometry><sphere><radius>2</radius></sphere></geometry></visual>
      <visual name='2'><geometry><cylinder><radius>1</radius><length>3</length></cylinder></geometry></visual>
      <visual name='3'><geometry><plane><normal>0 2 0</normal><size>5 6</size></plane></geometry></visual>
      <visual name='4'><geometry><mesh><uri>model://meshes/parts_z_up.dae</uri><scale>1 2 3</scale>
        <submesh><name>Leaf</name><center>true</center></submesh></mesh></geometry></visual>
      <visual name='5'><geometry><empty/></geometry></visual>
      <visual name='6'><geometry><polyline><height>1</height></polyline></geometry></visual>
    </link>)");
  const auto& v = m->links.at(0).visuals;
  ASSERT_EQ(v.size(), 4u);
  EXPECT_EQ(std::get<Sphere>(v[0].geometry).radius_m, 2.0);
  EXPECT_EQ(std::get<Cylinder>(v[1].geometry).length_m, 3.0);
  EXPECT_EQ(std::get<Plane>(v[2].geometry).normal, Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(std::get<Plane>(v[2].geometry).size_m, Eigen::Vector2d(5, 6));
  const Mesh& mesh = std::get<Mesh>(v[3].geometry);
  EXPECT_EQ(mesh.submesh, "Leaf");
  EXPECT_TRUE(mesh.center);
  EXPECT_EQ(mesh.scale, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(warnings_->size(), 1u);
  EXPECT_TRUE(warned("<polyline>: has no effect: shape not supported"));
}

TEST_F(SdfLink, ReadsTheLookOfVisuals) {
  const auto m = model(R"(<link name='a'><visual name='v'>
      <geometry><sphere><radius>2</radius></sphere></geometry>
      <transparency>0.25</transparency><cast_shadows>0</cast_shadows><laser_retro>3</laser_retro>
      <material><ambient>0.1 0.2 0.3 1</ambient><diffuse>0.4 0.5 0.6</diffuse>
        <specular>0.7 0.7 0.7 1</specular><emissive>0.8 0.9 1 0.5</emissive></material>
    </visual><visual name='plain'><geometry><sphere><radius>2</radius></sphere></geometry></visual></link>)");
  const Visual& v = m->links.at(0).visuals.at(0);
  EXPECT_EQ(v.transparency, 0.25);
  EXPECT_FALSE(v.cast_shadows);
  EXPECT_EQ(v.laser_retro, 3.0);
  EXPECT_TRUE(v.material->ambient.isApprox(Color(0.1f, 0.2f, 0.3f, 1)));
  EXPECT_TRUE(v.material->diffuse.isApprox(Color(0.4f, 0.5f, 0.6f, 1)));
  EXPECT_TRUE(v.material->specular.isApprox(Color(0.7f, 0.7f, 0.7f, 1)));
  EXPECT_TRUE(v.material->emissive.isApprox(Color(0.8f, 0.9f, 1, 0.5f)));
  EXPECT_FALSE(v.material->two_sided);
  EXPECT_FALSE(m->links.at(0).visuals.at(1).material);
}

TEST_F(SdfLink, KeepsSensorsAndPluginsAsWritten) {
  const auto m = model(R"(<link name='a'>
      <sensor name='scan' type='ray'><pose>0 0 1 0 0 0</pose><update_rate>40</update_rate>
        <ray><range><min>0.1</min></range></ray>
        <plugin name='p' filename='libgazebo_ros_laser.so'><topicName>scan</topicName></plugin>
      </sensor></link>
      <plugin name='drive' filename='libdrive.so' extra='x'><torque>10</torque></plugin>)");
  const SensorDescription& s = m->links.at(0).sensors.at(0);
  EXPECT_EQ(s.name, "scan");
  EXPECT_EQ(s.type, "ray");
  EXPECT_EQ(s.update_rate_hz, 40.0);
  EXPECT_EQ(s.X_LS.p.z(), 1.0);
  EXPECT_EQ(s.element.child("ray")->child("range")->child("min")->text, "0.1");
  EXPECT_EQ(s.element.child("ray")->source.line, 3);
  EXPECT_EQ(s.plugins.at(0).filename, "libgazebo_ros_laser.so");
  EXPECT_EQ(s.plugins.at(0).element.child("topicName")->text, "scan");
  EXPECT_EQ(m->plugins.at(0).name, "drive");
  EXPECT_EQ(m->plugins.at(0).element.attributes.at("extra"), "x");
  EXPECT_EQ(m->plugins.at(0).element.child("torque")->text, "10");
}

TEST_F(SdfLink, WarnsOfMisspeltElementsOnly) {
  model("<link name='a'>\n<inertail/><enable_wind>0</enable_wind><foreign:thing/></link>");
  ASSERT_EQ(warnings_->size(), 1u);
  EXPECT_EQ(warnings_->at(0), "test.sdf:2: <inertail>: not an element of <link> in SDF, ignored");
}

TEST_F(SdfLink, WarnsOfAnInertiaThatNoBodyHas) {
  model(
      R"(<link name='a'><inertial><inertia><ixx>1</ixx><iyy>1</iyy><izz>3</izz></inertia></inertial></link>)");
  EXPECT_TRUE(warned("which no body has"));
}

TEST_F(SdfLink, StaticModelsNeedNoInertia) {
  EXPECT_NO_THROW(
      model("<static>1</static><link name='a'><inertial><mass>0</mass></inertial></link>"));
}

TEST_F(SdfLink, APlaneThatCollidesMayHaveNoSize) {
  const std::string plane = "<geometry><plane><size>0 0</size></plane></geometry>";
  const auto m = model("<static>1</static><link name='a'><collision name='c'>" + plane +
                       "</collision></link>");
  EXPECT_TRUE(std::holds_alternative<Plane>(m->links.at(0).collisions.at(0).geometry));
  EXPECT_TRUE(warned("found '0 0', expected two positive numbers"));
  EXPECT_HAS(
      error_of([&] { model("<link name='a'><visual name='v'>" + plane + "</visual></link>"); }),
      "found '0 0', expected two positive numbers");
}

TEST_F(SdfLink, AMaterialScriptWithoutNameIsNone) {
  const auto m = model(
      "<link name='a'><visual name='v'><geometry><box><size>1 1 1</size></box></geometry><material>"
      "<script><uri>file://media/materials/scripts/gazebo.material</uri></script></material>"
      "</visual></link>");
  EXPECT_EQ(m->links.at(0).visuals.at(0).material->diffuse, Material{}.diffuse);
  EXPECT_TRUE(warned("<script>: found no <name>"));
}

}  // namespace
}  // namespace ardee
