// SPDX-License-Identifier: MIT
// Tests of a loader that leaves out missing files, on descriptions that need them.
#include "fixture.h"

namespace ardee {
namespace {

constexpr const char* kBox = "<geometry><box><size>1 1 1</size></box></geometry>";

/// Returns a collision with a mesh.
std::string mesh(const std::string& name, const std::string& uri) {
  return "<collision name='" + name + "'><geometry><mesh><uri>" + uri +
         "</uri></mesh></geometry></collision>";
}

class MissingFilesTest : public ReadersTest {
 protected:
  MissingFilesTest() : ReadersTest(BadParts::kLeaveOut) {
    folder_.write_model("box", "<static>true</static><link name='l'><collision name='c'>" +
                                   std::string(kBox) + "</collision></link>");
  }

  /// Returns the only error that was reported.
  std::string only_error() const {
    EXPECT_EQ(errors_->size(), 1u);
    return errors_->empty() ? "" : errors_->front();
  }
};

std::string include(const std::string& name) {
  return "<include><uri>model://" + name + "</uri></include>";
}

TEST_F(MissingFilesTest, LeavesOutAnIncludeAndReadsWhatFollows) {
  const World w = world(include("box") + "\n" + include("tree") + "\n" + include("box"));
  ASSERT_EQ(w.models.size(), 2u);
  EXPECT_EQ(w.models[1].name, "box_0");
  EXPECT_HAS(only_error(), "test.world:2: <uri>: found 'model://tree', expected an existing file");
  EXPECT_HAS(only_error(), folder_.path() + "/tree");
}

TEST_F(MissingFilesTest, SaysOnceWhatIsNamedOftenAndAgainForTheNextWorld) {
  std::string rows;
  for (int i = 0; i < 1000; ++i) rows += include("tree");
  EXPECT_TRUE(world(rows).models.empty());
  EXPECT_EQ(errors_->size(), 1u);
  EXPECT_TRUE(world(rows).models.empty());
  EXPECT_EQ(errors_->size(), 2u);
}

TEST_F(MissingFilesTest, LeavesOutAnIncludeThatCannotBeRead) {
  folder_.write_model("torn", "<link name='l'>");
  folder_.write_model("wrong", "<link name='l'><pose>0 0</pose></link>");
  folder_.write_model("ring", include("ring"));
  const World w = world(include("torn") + include("wrong") + include("ring") + include("box"));
  ASSERT_EQ(w.models.size(), 2u);  // the ring of includes holds its other content, without itself
  EXPECT_EQ(w.models[1].name, "box");
  ASSERT_EQ(errors_->size(), 3u);
  EXPECT_HAS(errors_->at(0), "torn/model.sdf:");
  EXPECT_HAS(errors_->at(1), "<pose>: found '0 0'");
  EXPECT_HAS(errors_->at(2), "include cycle");
}

TEST_F(MissingFilesTest, FindsAModelThatHasComeSince) {
  EXPECT_TRUE(world(include("tree")).models.empty());
  folder_.write_model("tree", "<link name='l'/>");
  EXPECT_EQ(world(include("tree")).models.size(), 1u);
}

TEST_F(MissingFilesTest, LeavesOutWhatIsNestedInAModel) {
  folder_.write_model("orchard", "<static>true</static>" + include("box") + include("tree"));
  const World w = world(include("orchard"));
  ASSERT_EQ(w.models.size(), 1u);
  EXPECT_EQ(w.models[0].model->instances.size(), 1u);
  EXPECT_HAS(only_error(), "orchard/model.sdf:");
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(MissingFilesTest, LeavesOutMeshesAndHeightmapsAlone) {
  folder_.write("broken.stl", "solid nothing");
  const auto made =
      model("<link name='l'>" + mesh("gone", "file://gone.dae") + mesh("again", "file://gone.dae") +
            mesh("broken", "file://broken.stl") + "<collision name='kept'>" + kBox +
            "</collision><visual name='hill'><geometry><heightmap><uri>hill.png</uri>"
            "<size>1 1 1</size></heightmap></geometry></visual></link>");
  ASSERT_EQ(made->links[0].collisions.size(), 1u);
  EXPECT_EQ(made->links[0].collisions[0].name, "kept");
  EXPECT_TRUE(made->links[0].visuals.empty());
  ASSERT_EQ(errors_->size(), 3u);
  EXPECT_HAS(errors_->at(0), "'file://gone.dae'");
  EXPECT_HAS(errors_->at(1), "broken.stl");
  EXPECT_HAS(errors_->at(2), "'hill.png'");
}

TEST_F(MissingFilesTest, LeavesOutMeshesOfRobots) {
  const auto made = robot(
      "<link name='l'><visual><geometry>\n<mesh filename='package://gone/wheel.dae'/></geometry>"
      "</visual><collision><geometry><sphere radius='1'/></geometry></collision></link>");
  EXPECT_TRUE(made->links[0].visuals.empty());
  EXPECT_EQ(made->links[0].collisions.size(), 1u);
  EXPECT_HAS(only_error(), "found 'package://gone/wheel.dae', expected a known package");
}

TEST_F(MissingFilesTest, LeavesOutRowsOfATable) {
  folder_.write("rows.csv",
                "model,name,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,scale,label\n"
                "model://tree,a,0,0,0,0,0,0,1,0\nmodel://box,b,1,0,0,0,0,0,1,0\n"
                "model://tree,c,2,0,0,0,0,0,1,0\n");
  folder_.write_model("rows", "<static>true</static><ardee:instances>" + folder_.path() +
                                  "/rows.csv</ardee:instances>");
  const World w = world(include("rows"));
  ASSERT_EQ(w.models.at(0).model->instances.size(), 1u);
  EXPECT_EQ(w.models[0].model->instances[0].name, "b");
  EXPECT_HAS(only_error(), "rows.csv:2: found 'model://tree'");
}

TEST_F(MissingFilesTest, RefusesAModelThatIsWrittenWrongAllTheSame) {
  EXPECT_HAS(error_of([&] {
               model(
                   "<link name='l'><collision name='c'><geometry><mesh><uri></uri></mesh>"
                   "</geometry></collision></link>");
             }),
             "uri");
  EXPECT_TRUE(errors_->empty());
}

TEST_F(MissingFilesTest, LeavesOutASubmeshThatIsNotThere) {
  const auto made = model(
      "<link name='l'><visual name='v'><geometry><mesh><uri>" + data("meshes/parts_z_up.dae") +
      "</uri><submesh><name>Root</name></submesh></mesh></geometry></visual></link>");
  EXPECT_TRUE(made->links[0].visuals.empty());
  EXPECT_HAS(only_error(), "found no submesh 'Root' in");
}

struct BadPart {
  const char* xml;
  const char* said;
};

class BadPartsTest : public MissingFilesTest, public ::testing::WithParamInterface<BadPart> {};

/// A world has one bad part between good models: it gives one error, and its name is free.
TEST_P(BadPartsTest, AreLeftOutOfAWorld) {
  const World w = world("<model name='a'><link name='l'/></model>" + std::string(GetParam().xml) +
                        "<model name='m'><link name='l'/></model>");
  ASSERT_EQ(w.models.size(), 2u);
  EXPECT_EQ(w.models[0].name, "a");
  EXPECT_EQ(w.models[1].name, "m");
  EXPECT_TRUE(w.lights.empty());
  EXPECT_TRUE(w.plugins.empty());
  EXPECT_HAS(only_error(), GetParam().said);
  EXPECT_HAS(only_error(), "is left out");
}

INSTANTIATE_TEST_SUITE_P(
    World, BadPartsTest,
    ::testing::Values(
        BadPart{
            "<model name='m'><pose>1 2 3 0 0 0 9</pose><link name='l'/></model>",
            "found '1 2 3 0 0 0 9', expected six finite numbers (x y z roll pitch yaw); <model> "
            "'m' is left out"},
        BadPart{"<model name='m'><link name='l'/><joint name='j' type='fixed'><parent>l</parent>"
                "<child>nope</child></joint></model>",
                "'nope'"},
        BadPart{"<model name='m'><link name='l'/><model name='n'><static>1</static>"
                "<link name='z'><pose>0</pose></link></model></model>",
                "found '0'"},
        BadPart{"<model><link name='l'/></model>", "name"},
        BadPart{"<model name='q'><pose relative_to='x'/><link name='l'/></model>", "frame 'x'"},
        BadPart{"<include><uri></uri></include>", "<uri>"},
        BadPart{"<include/>", "found no <uri>, expected one; <include> '' is left out"},
        BadPart{"<include><uri>model://box</uri><name>m</name><ardee:scale>0</ardee:scale>"
                "</include>",
                "<include> 'm' is left out"},
        BadPart{"<light name='a' type='area'/>", "<light> 'a' is left out"},
        BadPart{"<plugin name='p'/>", "filename"},
        BadPart{"<frame name='f'><pose>0</pose></frame>", "<frame> 'f' is left out"},
        BadPart{"<population name='p'><model name='m'><link name='l'/></model></population>",
                "<population> 'p' is left out"},
        BadPart{"<state world_name='w'><insertions><model name='i'><link/></model></insertions>"
                "</state>",
                "<model> 'i' is left out"}));

TEST_F(MissingFilesTest, WhatIsLeftOutIsNoFrame) {
  const World w = world(
      "<model name='m'><link name='l'/><link name='l'/></model>"
      "<model name='on_it'><pose relative_to='m'>0 0 1 0 0 0</pose><link name='l'/></model>",
      "1.7");
  EXPECT_TRUE(w.models.empty());
  ASSERT_EQ(errors_->size(), 2u);
  EXPECT_HAS(errors_->at(1), "found frame 'm'");
}

TEST_F(MissingFilesTest, LeavesOutWhatWasNotDownloaded) {
  const World w =
      world("<include><uri>https://fuel.gazebosim.org/1.0/o/models/Cone</uri></include>" +
            include("box"));
  EXPECT_EQ(w.models.size(), 1u);
  EXPECT_HAS(only_error(), "found 'https://fuel.gazebosim.org/1.0/o/models/Cone'");
}

}  // namespace
}  // namespace ardee
