// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/schema.h"
#include "fixture.h"
#include "specification.h"

namespace ardee {
namespace {

using SchemaTest = ReadersTest;

TEST_F(SchemaTest, HasEachElementAndAttributeOfTheSpecificationAtEachPlace) {
  for (const std::string& version : SpecificationWalk::versions()) {
    const SpecificationWalk walk(version);
    EXPECT_GT(walk.met().size(), 150u) << version;
  }
}

/// Returns the last part of "place/name".
std::string name_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

TEST_F(SchemaTest, HasNoOtherNamesButItsOwnAndNewerOnes) {
  std::set<std::string> known{"ardee:scale", "ardee:label", "ardee:instances", "@filename",
                              // Entries of SDF 1.10 to 1.12, and those that its package leaves out
                              // of 1.7 to 1.9
                              "@auto", "@optimization", "air_speed", "anti_aliasing",
                              "auto_inertia_params", "camera_info_topic", "cone",
                              "convex_decomposition", "cubemap_uri", "density", "fluid_added_mass",
                              "frame_id", "gz_frame_id", "ignition_frame_id", "light_on", "mimic",
                              "navsat", "optical_frame_id", "projection", "screw_thread_pitch",
                              "shininess", "surface_axis_equatorial", "surface_axis_polar",
                              "trigger_topic", "triggered", "position_sensing", "velocity_sensing"};
  for (const std::string& version : SpecificationWalk::versions()) {
    const SpecificationWalk walk(version);
    for (const std::string& path : walk.met()) known.insert(name_of(path));
  }
  for (const auto& [name, place] : sdf_schema().places()) {
    for (const auto& [child, entry] : place.entries) {
      EXPECT_TRUE(known.count(child)) << name << "/" << child << " is in no version of SDF";
    }
  }
}

TEST_F(SchemaTest, SaysWhyWhatHasNoEffectHasNone) {
  for (const Schema* schema : {&sdf_schema(), &urdf_schema(), &gazebo_schema()}) {
    for (const SchemaRow& row : schema->rows()) {
      EXPECT_TRUE(row.treatment == Treatment::kActs || *row.note != '\0')
          << row.place << ": " << row.names;
    }
  }
}

TEST_F(SchemaTest, ANameMeansWhatItDoesAtItsPlace) {
  model(
      "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent>"
      "<child>b</child><axis><xyz>0 0 1</xyz></axis><physics><max_step_size>1</max_step_size>"
      "<ode><mu>1</mu><limit><cfm>0</cfm><lower>1</lower></limit></ode></physics></joint>");
  ASSERT_EQ(warnings_->size(), 3u);
  EXPECT_TRUE(warned("<max_step_size>: not an element of <physics> in SDF, ignored"));
  EXPECT_TRUE(warned("<mu>: not an element of <ode> in SDF, ignored"));
  EXPECT_TRUE(warned("<lower>: not an element of <limit> in SDF, ignored"));
}

TEST_F(SchemaTest, WarnsOnceOfEachThatHasNoEffectAndSaysWhy) {
  const std::string link =
      "<enable_wind>1</enable_wind><projector name='p'><fov>1</fov></projector>";
  model("<link name='a'>" + link + "</link><link name='b'>" + link + "</link>");
  ASSERT_EQ(warnings_->size(), 2u);
  EXPECT_EQ(warnings_->at(0),
            "test.sdf:1: <enable_wind>: has no effect: no wind blows (and 1 more)");
  EXPECT_TRUE(warned("<projector>: has no effect: not supported in a link, left out"));
}

TEST_F(SchemaTest, WarnsOfASecondOneWhereOneCounts) {
  const std::string ball = "<geometry><sphere><radius>1</radius></sphere></geometry>";
  const auto made =
      model("<pose>1 0 0 0 0 0</pose><pose>2 0 0 0 0 0</pose><link name='l'><collision name='c'>" +
            ball + "</collision><collision name='c'>" + ball + "</collision></link>");
  EXPECT_EQ(made->own_pose.p.x(), 1.0);
  ASSERT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<pose>: found a second one in <model>, expected one: only the first counts"));
  EXPECT_TRUE(warned("<collision>: found a second one of the name 'c', expected another"));
}

TEST_F(SchemaTest, WarnsOfWhatStandsBesideTheModelThatIsRead) {
  const std::string link = "<link name='l'/></model>", light = "<light name='s' type='point'/>";
  for (const std::string& text : {"<model name='m'>" + link + "<model name='n'>" + link,
                                  "<world name='w'><model name='m'>" + link + light + "</world>"}) {
    warnings_->clear();
    const auto made = loader_.load_model_text("<sdf version='1.6'>" + text + "</sdf>", "test.sdf");
    EXPECT_EQ(made->name, "m");
    ASSERT_EQ(warnings_->size(), 1u) << text;
    EXPECT_TRUE(warned("found it beside the <model> that is read, expected that alone"));
  }
}

TEST_F(SchemaTest, WhatSaysTheSameAsItsAbsenceIsNoWarning) {
  world(
      "<magnetic_field>6e-06 2.3e-05 -4.2e-05</magnetic_field><wind/><atmosphere type='adiabatic'/>"
      "<audio/><gui fullscreen='0'><camera name='c'><pose frame=''>0 0 0 0 0 0</pose>"
      "<view_controller>orbit</view_controller></camera></gui>"
      "<model name='m'><allow_auto_disable>1</allow_auto_disable><link name='l'>"
      "<enable_wind>0</enable_wind><must_be_base_link>false</must_be_base_link>"
      "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry><surface>"
      "<friction><torsional><coefficient>1.0</coefficient><use_patch_radius>1</use_patch_radius>"
      "<ode/></torsional><ode/></friction><contact><ode/></contact><bounce/></surface></collision>"
      "</link></model>");
  EXPECT_EQ(*warnings_,
            std::vector<std::string>{"test.world:1: <audio>: has no effect: there is no sound"});
}

TEST_F(SchemaTest, KnowsAttributes) {
  model("<link name='l' colour='red'><pose frame='x' relative_to=''>0 0 0 0 0 0</pose></link>");
  ASSERT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<link>: 'colour' is no attribute of <link> in SDF, ignored"));
  EXPECT_TRUE(warned("<pose>: attribute 'frame' has no effect: SDF 1.7's relative_to"));
}

TEST_F(SchemaTest, LeavesForeignNamespacesToTheirOwners) {
  model("<my:note x='1'/><link name='l' my:colour='red'/>");
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SchemaTest, LooksIntoSensorsButNotIntoPlugins) {
  model(
      "<link name='l'><sensor name='s' "
      "type='ray'><visualize>true</visualize><ray><scan><horizontal>"
      "<sample>3</sample></horizontal></scan></ray><plugin name='p' filename='f'><any>1</any>"
      "</plugin></sensor></link>");
  ASSERT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<visualize>: has no effect: the simulator has no window"));
  EXPECT_TRUE(warned("<sample>: not an element of <horizontal> in SDF, ignored"));
}

TEST_F(SchemaTest, LooksIntoGazeboBlocksOfUrdf) {
  robot(
      "<link name='l'/><gazebo reference='l'><mu1 value='0.9'/><light name='x'/>"
      "<sensor name='s' type='ray'><ray><scan><horizontl/></scan></ray>"
      "<plugin name='p' filename='f'/></sensor><visual><transparancy>1</transparancy></visual>"
      "</gazebo><gazebo><enable_wind>true</enable_wind></gazebo>");
  ASSERT_EQ(warnings_->size(), 5u);
  EXPECT_TRUE(warned("<mu1>: has no effect: the link has no collision"));
  EXPECT_TRUE(warned("<light>: has no effect: not supported in a link, left out"));
  EXPECT_TRUE(warned("<horizontl>: not an element of <scan> in URDF, ignored"));
  EXPECT_TRUE(warned("<transparancy>: not an element of <visual> in URDF, ignored"));
  EXPECT_TRUE(warned("<enable_wind>: has no effect: no wind blows"));
}

TEST_F(SchemaTest, KnowsUrdf) {
  robot(
      "<link name='a'><inertial><mass value='1' unit='kg'/><inertia ixx='1' ixy='0' ixz='0'"
      " iyy='1' iyz='0' izz='1'/></inertial></link><link name='b'/><joint name='j' type='fixed'>"
      "<parent link='a'/><child link='b'/></joint>"
      "<transmission name='t'><type>T</type><joint name='j'><hardwareInterface>H"
      "</hardwareInterface></joint><actuator name='m'><mechanicalReduction>2"
      "</mechanicalReduction></actuator><gear/></transmission>");
  ASSERT_EQ(warnings_->size(), 2u);
  EXPECT_TRUE(warned("<mass>: 'unit' is no attribute of <mass> in URDF, ignored"));
  EXPECT_TRUE(warned("<gear>: not an element of <transmission> in URDF, ignored"));
}

}  // namespace
}  // namespace ardee
