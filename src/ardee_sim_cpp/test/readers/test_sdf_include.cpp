// SPDX-License-Identifier: MIT
#include "ardee_sim/description/scenery.h"
#include "fixture.h"

namespace ardee {
namespace {

constexpr const char* kStaticBox =
    "<static>true</static><link name='link'><collision name='c'><geometry><box><size>1 1 "
    "1</size></box>"
    "</geometry></collision></link>";
constexpr const char* kQuarterTurn = "1.5707963267948966";

class SdfInclude : public ReadersTest {
 protected:
  SdfInclude() { folder_.write_model("box", kStaticBox); }
};

std::string include(const std::string& name, const std::string& more = "") {
  return "<include><uri>model://" + name + "</uri>" + more + "</include>";
}

TEST_F(SdfInclude, TakesPoseNameAndStatic) {
  folder_.write_model("ball", "<pose>0 0 5 0 0 0</pose><link name='link'/>");
  const World w =
      world(include("ball") +
            include("ball", "<name>b</name><pose>1 2 3 0 0 0</pose><static>1</static>"));
  EXPECT_EQ(w.models.at(0).name, "ball");
  EXPECT_EQ(w.models.at(0).pose.p.z(), 5.0);
  EXPECT_FALSE(w.models.at(0).is_static);
  EXPECT_EQ(w.models.at(1).name, "b");
  expect_near(w.models.at(1).pose.p, {1, 2, 3});
  EXPECT_TRUE(w.models.at(1).is_static);
}

TEST_F(SdfInclude, ReadsAModelOnce) {
  const World first = world(include("box") + include("box"));
  std::filesystem::remove_all(folder_.path() + "/box");
  const World second = world(include("box"));
  EXPECT_EQ(first.models.at(0).model, first.models.at(1).model);
  EXPECT_EQ(first.models.at(0).model, second.models.at(0).model);
}

TEST_F(SdfInclude, NumbersModelsOfTheSameName) {
  const World w = world(include("box") + include("box") + include("box") +
                        include("box", "<name>box_0</name>"));
  EXPECT_EQ(w.models.at(0).name, "box");
  EXPECT_EQ(w.models.at(1).name, "box_0");
  EXPECT_EQ(w.models.at(2).name, "box_1");
  EXPECT_EQ(w.models.at(3).name, "box_0_0");
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SdfInclude, ReadsTwentyThousandToOneDescription) {
  std::string body;
  for (int i = 0; i < 20000; ++i)
    body += include("box", "<pose>" + std::to_string(i) + " 0 0 0 0 0</pose>");
  const World w = world(body);
  ASSERT_EQ(w.models.size(), 20000u);
  EXPECT_EQ(w.models.back().name, "box_19998");
  EXPECT_EQ(w.models.back().pose.p.x(), 19999.0);
  EXPECT_EQ(w.models.back().model.use_count(), w.models.front().model.use_count());
  EXPECT_EQ(w.models.back().model, w.models.front().model);
}

TEST_F(SdfInclude, ReadsScaleAndLabel) {
  const World w =
      world(include("box", "<ardee:scale>1.5</ardee:scale><ardee:label>7</ardee:label>"));
  EXPECT_EQ(w.models.at(0).scale, 1.5);
  EXPECT_EQ(w.models.at(0).label, 7u);
  for (const char* bad : {"0", "-1", "nan"}) {
    EXPECT_HAS(error_of([&] {
                 world(include("box", "<ardee:scale>" + std::string(bad) + "</ardee:scale>"));
               }),
               "<ardee:scale>: found");
  }
  EXPECT_HAS(error_of([&] { world(include("box", "<ardee:label>0</ardee:label>")); }),
             "<ardee:label>: found '0'");
}

TEST_F(SdfInclude, KeepsStaticModelsOfAFieldAsInstances) {
  folder_.write_model(
      "row", "<static>1</static>" +
                 include("box", std::string("<pose>1 0 0 0 0 ") + kQuarterTurn + "</pose>") +
                 include("box", "<pose>2 0 0 0 0 0</pose><ardee:scale>2</ardee:scale>"));
  folder_.write_model("field",
                      include("row", std::string("<pose>0 10 0 0 0 ") + kQuarterTurn + "</pose>"));
  const World w = world(include("field", "<pose>0 0 1 0 0 0</pose>"));
  const auto placed = flatten_scenery(w.models.at(0));
  ASSERT_EQ(placed.size(), 2u);
  // The row is turned by 90 degrees at (0, 10, 1): its x runs along the world's y.
  expect_near(placed[0].X_WM.p, {0, 11, 1});
  expect_near(placed[0].X_WM.q * Eigen::Vector3d::UnitX(), {-1, 0, 0});
  expect_near(placed[1].X_WM.p, {0, 12, 1});
  EXPECT_EQ(placed[1].scale, 2.0);
  EXPECT_EQ(placed[0].model, placed[1].model);
}

TEST_F(SdfInclude, MergesMovingModelsUnderScopedNames) {
  folder_.write_model(
      "arm",
      "<link name='upper'><pose>1 0 0 0 0 0</pose></link><link name='lower'/>"
      "<joint name='elbow' type='revolute'><parent>upper</parent><child>lower</child>"
      "<axis><xyz>0 0 1</xyz></axis></joint>"
      "<plugin name='p' filename='p.so'><bodyName>lower</bodyName><other>x</other></plugin>");
  const auto m = model(
      "<link name='base'/>" +
      include("arm", std::string("<name>left</name><pose>0 0 3 0 0 ") + kQuarterTurn + "</pose>") +
      "<joint name='mount' type='fixed'><parent>base</parent><child>left::upper</child></joint>");
  ASSERT_EQ(m->links.size(), 3u);
  EXPECT_EQ(m->canonical_link, "base");
  const Link* upper = m->find_link("left::upper");
  ASSERT_TRUE(upper);
  expect_near(upper->X_ML.p, {0, 1, 3});
  const Joint* elbow = m->find_joint("left::elbow");
  ASSERT_TRUE(elbow);
  EXPECT_EQ(elbow->parent, "left::upper");
  EXPECT_EQ(elbow->child, "left::lower");
  expect_near(elbow->axis.axis, {0, 0, 1});
  EXPECT_EQ(m->plugins.at(0).element.child("bodyName")->text, "lower");
  EXPECT_EQ(m->plugins.at(0).scope, "left::");
  EXPECT_TRUE(m->instances.empty());
}

TEST_F(SdfInclude, AMergedIncludeKeepsItsNames) {
  folder_.write_model("arm",
                      "<frame name='tip'><pose>0 0 1 0 0 0</pose></frame><link name='upper'/>"
                      "<link name='lower'/><joint name='elbow' type='fixed'><parent>upper</parent>"
                      "<child>lower</child></joint><plugin name='p' filename='p.so'/>",
                      "1.9");
  const auto m = model(
      "<link name='base'/><include merge='true'><uri>model://arm</uri><pose>1 0 0 0 0 0</pose>"
      "</include><joint name='mount' "
      "type='fixed'><parent>base</parent><child>upper</child></joint>",
      "1.9");
  ASSERT_EQ(m->links.size(), 3u);
  expect_near(m->find_link("upper")->X_ML.p, {1, 0, 0});
  EXPECT_EQ(m->find_joint("elbow")->child, "lower");
  EXPECT_EQ(m->find_joint("mount")->child, "upper");
  EXPECT_EQ(m->plugins.size(), 1u);
  expect_near(m->find_frame("tip")->X_MF.p, {1, 0, 1});
  EXPECT_HAS(error_of([&] {
               model("<link name='upper'/><include merge='1'><uri>model://arm</uri></include>",
                     "1.9");
             }),
             "found a second link 'upper'");
}

TEST_F(SdfInclude, WhatIsMergedHoldsAndPlacesOthers) {
  folder_.write_model("arm",
                      "<link name='arm'><pose>0 1 0 0 0 0</pose></link><link name='hand'/>"
                      "<frame name='flange' attached_to='arm'><pose>0 0 1 0 0 0</pose></frame>"
                      "<joint name='wrist' type='fixed'><parent>arm</parent><child>hand</child>"
                      "<pose>0 0 3 0 0 0</pose></joint>",
                      "1.9");
  const auto m = model(
      "<link name='tool'><pose relative_to='flange'>0 0 1 0 0 0</pose></link>"
      "<link name='ring'><pose relative_to='wrist'/></link>"
      "<include merge='true'><uri>model://arm</uri><pose>1 0 0 0 0 0</pose></include>"
      "<joint name='mount' type='fixed'><parent>flange</parent><child>tool</child></joint>"
      "<joint name='other' type='fixed'><parent>arm</parent><child>ring</child></joint>",
      "1.9");
  expect_near(m->find_link("tool")->X_ML.p, {1, 1, 2});
  expect_near(m->find_link("ring")->X_ML.p, {1, 0, 3});
  EXPECT_EQ(m->find_joint("mount")->parent, "arm");
  EXPECT_EQ(m->find_joint("other")->parent, "arm");
}

TEST_F(SdfInclude, APlacementFrameStandsWhereThePoseSays) {
  const std::string arm =
      "<link name='l'/><frame name='foot'><pose>0 0 -2 0 0 0</pose></frame>"
      "<link name='tip'><pose>0 0 1 0 0 0</pose></link>";
  folder_.write_model("arm", arm, "1.9");
  folder_.write("standing/model.sdf",
                "<sdf version='1.9'><model name='standing' "
                "placement_frame='foot'>" +
                    arm + "</model></sdf>");
  const auto place = [&](const std::string& name, const std::string& more) {
    return world(include(name, "<name>n</name><pose>1 0 0 0 0 0</pose>" + more), "1.9")
        .models.at(0)
        .pose;
  };
  expect_near(place("arm", "").p, {1, 0, 0});
  expect_near(place("arm", "<placement_frame>foot</placement_frame>").p, {1, 0, 2});
  expect_near(place("arm", "<placement_frame>tip</placement_frame>").p, {1, 0, -1});
  expect_near(place("standing", "").p, {1, 0, 2});
  expect_near(place("standing", "<placement_frame>tip</placement_frame>").p, {1, 0, -1});
  EXPECT_HAS(error_of([&] { place("arm", "<placement_frame>head</placement_frame>"); }),
             "<placement_frame>: found frame 'head', expected one of the model");
  const auto nested = model("<link name='base'/><model name='n' placement_frame='foot'>" + arm +
                                "</model><link name='on'><pose relative_to='n'/></link>",
                            "1.9");
  expect_near(nested->find_link("n::l")->X_ML.p, {0, 0, 2});
}

TEST_F(SdfInclude, FramesOfANestedModelAreFoundByTheirScopedNames) {
  folder_.write_model("arm", "<link name='l'/><frame name='f'><pose>0 0 2 0 0 0</pose></frame>",
                      "1.9");
  const auto m =
      model("<link name='base'/>" + include("arm", "<name>n</name><pose>1 0 0 0 0 0</pose>") +
                "<joint name='j' type='fixed'><parent>base</parent><child>n::f</child></joint>",
            "1.9");
  EXPECT_EQ(m->find_joint("j")->child, "n::l");
  expect_near(m->find_joint("j")->X_CJ.p, {0, 0, 2});
}

TEST_F(SdfInclude, MergesNestedModelElementsToAnyDepth) {
  const auto m = model(
      "<link name='a'/><model name='b'><pose>1 0 0 0 0 0</pose><link name='l'/>"
      "<model name='c'><pose>0 1 0 0 0 0</pose><link name='l'><pose>0 0 1 0 0 "
      "0</pose></link></model></model>");
  expect_near(m->find_link("b::c::l")->X_ML.p, {1, 1, 1});
}

TEST_F(SdfInclude, EverythingBelowAStaticModelIsStatic) {
  folder_.write_model("loose", "<link name='link'/>");
  const auto m =
      model("<static>1</static>" + include("loose") + "<model name='n'><link name='l'/></model>");
  ASSERT_EQ(m->instances.size(), 2u);
  EXPECT_TRUE(m->instances[0].is_static && m->instances[0].model->is_static);
  EXPECT_TRUE(m->instances[1].is_static && m->instances[1].model->is_static);
  const World w = world(include("loose") + include("loose", "<static>1</static>"));
  EXPECT_FALSE(w.models[0].is_static);
  EXPECT_TRUE(w.models[1].is_static);
}

TEST_F(SdfInclude, AddsTheLightOfAnIncludedSun) {
  folder_.write("sun/model.sdf", "<sdf version='1.5'><light type='directional' name='sun'/></sdf>");
  const World w = world("<include><uri>model://sun</uri></include>");
  EXPECT_TRUE(w.models.empty());
  EXPECT_EQ(w.lights.at(0).name, "sun");
  const World placed = world(
      "<frame name='f'><pose>0 0 4 0 0 0</pose></frame><include><uri>model://sun</uri>"
      "<name>lamp</name><pose relative_to='f'>1 2 3 0 0 0</pose></include>",
      "1.7");
  EXPECT_EQ(placed.lights.at(0).name, "lamp");
  expect_near(placed.lights.at(0).pose.p, {1, 2, 7});
}

TEST_F(SdfInclude, AddsAnIncludesPluginToItsModelAlone) {
  const World w = world(include("box") + include("box", "<plugin name='p' filename='p.so'/>"));
  EXPECT_TRUE(w.models.at(0).model->plugins.empty());
  EXPECT_EQ(w.models.at(1).model->plugins.size(), 1u);
}

TEST_F(SdfInclude, RefusesACycle) {
  folder_.write_model("a", include("b"));
  folder_.write_model("b", include("a"));
  const std::string error = error_of([&] { world(include("a")); });
  EXPECT_HAS(error, "found an include cycle");
  EXPECT_HAS(error, "/a/model.sdf -> " + folder_.path() + "/b/model.sdf");
  EXPECT_NO_THROW(world(include("box")));
}

TEST_F(SdfInclude, RefusesModelsThatMultiplyBeyondReason) {
  std::string previous = "box";
  for (int level = 0; level < 4; ++level) {
    std::string body = "<static>1</static>";
    for (int i = 0; i < 100; ++i) body += include(previous);
    previous = "level" + std::to_string(level);
    folder_.write_model(previous, body);
  }
  EXPECT_HAS(error_of([&] { world(include(previous)); }), "static models, expected fewer");
}

TEST_F(SdfInclude, FindsRelativeUrisBesideTheFile) {
  folder_.write("worlds/near.sdf",
                "<sdf version='1.5'><model name='near'><link name='l'/></model></sdf>");
  const std::string path = folder_.write(
      "worlds/w.world",
      "<sdf version='1.5'><world name='w'><include><uri>near.sdf</uri></include></world></sdf>");
  EXPECT_EQ(loader_.load_world(path).models.at(0).name, "near");
}

TEST_F(SdfInclude, AModelMayComeWrappedInAWorld) {
  folder_.write_model("box", "<link name='l'/>");
  const auto wrapped = [this](const std::string& body) {
    return loader_.load_model_text(
        "<sdf version='1.4'><world name='default'>" + body + "</world></sdf>", "test.sdf");
  };
  EXPECT_EQ(wrapped("<include><uri>model://box</uri></include>")->name, "box");
  EXPECT_EQ(wrapped("<model name='own'><link name='l'/></model>")->name, "own");
  EXPECT_HAS(error_of([&] { wrapped(""); }), "<world>: found no <model>, expected one");
}

}  // namespace
}  // namespace ardee
