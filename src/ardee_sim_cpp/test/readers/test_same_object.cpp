// SPDX-License-Identifier: MIT
#include "fixture.h"

namespace ardee {
namespace {

/// Listing A.1, with the lines that its page lost restored.
constexpr const char* kSdf = R"(<?xml version="1.0"?>
<sdf version="1.5">
  <model name="sensor_gps">
    <link name="gps_link">
      <inertial>
        <mass>0.5</mass>
        <pose>0 0 0 0 0 0</pose>
        <inertia><ixx>0.05</ixx><ixy>0.0</ixy><ixz>0.0</ixz><iyy>0.05</iyy><iyz>0.0</iyz><izz>0.05</izz></inertia>
      </inertial>
      <collision name="gps_link_collision">
        <pose>0 0 0 0 0 0</pose>
        <geometry><mesh><uri>model://simple_gps_model/meshes/antenna_3GO16.stl</uri></mesh></geometry>
      </collision>
      <visual name="gps_link_visual">
        <pose>0 0 0 0 0 0</pose>
        <geometry><mesh><uri>model://simple_gps_model/meshes/antenna_3GO16.stl</uri></mesh></geometry>
        <material><script><name>Gazebo/White</name></script></material>
      </visual>
    </link>
    PLUGIN
  </model>
</sdf>)";

/// Listing A.2 with its macro called as sensor_gps(name=gps, color=white).
constexpr const char* kUrdf = R"(<?xml version="1.0"?>
<robot name="sensor_gps">
  <link name="gps_link">
    <inertial>
      <mass value="0.5" />
      <origin rpy="0 0 0" xyz="0 0 0" />
      <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05" />
    </inertial>
    <visual>
      <origin rpy="0 0 0" xyz="0 0 0" />
      <geometry><mesh filename="package://simple_gps_model/meshes/antenna_3GO16.stl" /></geometry>
    </visual>
    <collision>
      <origin rpy="0 0 0" xyz="0 0 0" />
      <geometry><mesh filename="package://simple_gps_model/meshes/antenna_3GO16.stl" scale="1.0 1.0 1.0" /></geometry>
    </collision>
  </link>
  <gazebo reference="gps_link"><material>Gazebo/White</material></gazebo>
  <gazebo>PLUGIN</gazebo>
</robot>)";

constexpr const char* kPlugin = R"(<plugin name="gps_controller" filename="libgazebo_ros_gps.so">
      <bodyName>gps_link</bodyName><frameId>gps_link</frameId><topicName>gps</topicName>
      <velocityTopicName>gps/fix_velocity</velocityTopicName><updateRate>5</updateRate>
      <gaussianNoise>0.05 0.05 0.05</gaussianNoise><alwaysOn>1</alwaysOn>
      <referenceAltitude>-32.593</referenceAltitude><referenceLatitude>40.1105875</referenceLatitude>
      <referenceLongitude>-88.2072697</referenceLongitude></plugin>)";

std::string with_plugin(std::string text) { return text.replace(text.find("PLUGIN"), 6, kPlugin); }

void expect_same(const Pose& a, const Pose& b) {
  expect_near(a.p, b.p);
  EXPECT_LT(a.q.angularDistance(b.q), 1e-12);
}

void expect_same(const Geometry& a, const Geometry& b) {
  EXPECT_EQ(std::get<Mesh>(a).file, std::get<Mesh>(b).file);
  EXPECT_EQ(std::get<Mesh>(a).scale, std::get<Mesh>(b).scale);
  EXPECT_EQ(std::get<Mesh>(a).submesh, std::get<Mesh>(b).submesh);
}

void expect_same(const Surface& a, const Surface& b) {
  EXPECT_EQ(a.mu, b.mu);
  EXPECT_EQ(a.mu2, b.mu2);
  EXPECT_EQ(a.fdir1, b.fdir1);
  EXPECT_EQ(a.kp_n_per_m, b.kp_n_per_m);
  EXPECT_EQ(a.kd_n_s_per_m, b.kd_n_s_per_m);
  EXPECT_EQ(a.max_contacts, b.max_contacts);
}

void expect_same(const Element& a, const Element& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.text, b.text);
  EXPECT_EQ(a.attributes, b.attributes);
  ASSERT_EQ(a.children.size(), b.children.size());
  for (std::size_t i = 0; i < a.children.size(); ++i) expect_same(a.children[i], b.children[i]);
}

void expect_same(const Link& a, const Link& b) {
  EXPECT_EQ(a.name, b.name);
  expect_same(a.X_ML, b.X_ML);
  EXPECT_EQ(a.inertial->mass_kg, b.inertial->mass_kg);
  expect_same(a.inertial->X_LI, b.inertial->X_LI);
  EXPECT_EQ(a.inertial->inertia_kg_m2, b.inertial->inertia_kg_m2);
  ASSERT_EQ(a.collisions.size(), b.collisions.size());
  for (std::size_t i = 0; i < a.collisions.size(); ++i) {
    EXPECT_EQ(a.collisions[i].name, b.collisions[i].name);
    expect_same(a.collisions[i].X_LC, b.collisions[i].X_LC);
    expect_same(a.collisions[i].geometry, b.collisions[i].geometry);
    expect_same(a.collisions[i].surface, b.collisions[i].surface);
  }
  ASSERT_EQ(a.visuals.size(), b.visuals.size());
  for (std::size_t i = 0; i < a.visuals.size(); ++i) {
    EXPECT_EQ(a.visuals[i].name, b.visuals[i].name);
    expect_same(a.visuals[i].X_LV, b.visuals[i].X_LV);
    expect_same(a.visuals[i].geometry, b.visuals[i].geometry);
    EXPECT_EQ(a.visuals[i].material->name, b.visuals[i].material->name);
    EXPECT_EQ(a.visuals[i].material->diffuse, b.visuals[i].material->diffuse);
  }
}

TEST_F(ReadersTest, TheGpsOfListingsA1AndA2IsTheSameInSdfAndUrdf) {
  std::filesystem::create_directories(folder_.path() + "/simple_gps_model/meshes");
  std::filesystem::copy_file(data("meshes/cube.stl"),
                             folder_.path() + "/simple_gps_model/meshes/antenna_3GO16.stl");
  const auto sdf = loader_.load_model_text(with_plugin(kSdf), "model.sdf");
  const auto urdf = loader_.load_model_text(with_plugin(kUrdf), "gps.urdf");
  EXPECT_EQ(sdf->name, urdf->name);
  EXPECT_EQ(sdf->is_static, urdf->is_static);
  EXPECT_EQ(sdf->canonical_link, urdf->canonical_link);
  EXPECT_EQ(sdf->joints.size(), urdf->joints.size());
  ASSERT_EQ(sdf->links.size(), 1u);
  ASSERT_EQ(urdf->links.size(), 1u);
  expect_same(sdf->links[0], urdf->links[0]);
  ASSERT_EQ(sdf->plugins.size(), 1u);
  ASSERT_EQ(urdf->plugins.size(), 1u);
  EXPECT_EQ(sdf->plugins[0].filename, urdf->plugins[0].filename);
  expect_same(sdf->plugins[0].element, urdf->plugins[0].element);
  EXPECT_TRUE(warnings_->empty());
}

}  // namespace
}  // namespace ardee
