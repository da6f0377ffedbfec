// SPDX-License-Identifier: MIT
#include "fixture.h"

namespace ardee {
namespace {

constexpr const char* kQuarter = "1.5707963267948966";  // a quarter turn [rad]

/// Poses of SDF 1.7 relative to each other
/// (http://sdformat.org/tutorials?tut=pose_frame_semantics).
class SdfFramesTest : public ReadersTest {
 protected:
  std::shared_ptr<const Model> model(const std::string& body) {
    return ReadersTest::model(body, "1.7");
  }
  World world(const std::string& body) { return ReadersTest::world(body, "1.7"); }

  static std::string pose(const std::string& relative_to, const std::string& values) {
    return "<pose relative_to='" + relative_to + "'>" + values + "</pose>";
  }
  static std::string turned(const std::string& xyz) { return xyz + " 0 0 " + kQuarter; }
  static std::string link(const std::string& name, const std::string& inside = "") {
    return "<link name='" + name + "'>" + inside + "</link>";
  }
  static std::string fixed(const std::string& parent, const std::string& child,
                           const std::string& inside = "") {
    return "<joint name='j_" + child + "' type='fixed'><parent>" + parent + "</parent><child>" +
           child + "</child>" + inside + "</joint>";
  }
};

TEST_F(SdfFramesTest, ALinkIsPlacedInAnotherWhateverTheirOrder) {
  // a is turned, so one metre along its x is one along the model's y.
  const auto m = model(link("b", pose("a", "1 0 0 0 0 0")) +
                       link("a", "<pose>" + turned("1 2 3") + "</pose>"));
  expect_near(m->find_link("b")->X_ML.p, {1, 3, 3});
  expect_near(m->find_link("b")->X_ML.q * Eigen::Vector3d::UnitX(), {0, 1, 0});
}

TEST_F(SdfFramesTest, AFrameWithoutPlaceOfItsOwnIsWhereItIsAttached) {
  const auto m = model(link("a", "<pose>" + turned("1 0 0") + "</pose>") +
                       "<frame name='tip' attached_to='a'><pose>0.5 0 0 0 0 0</pose></frame>"
                       "<frame name='same' attached_to='tip'/>"
                       "<frame name='high'><pose>0 0 2 0 0 0</pose></frame>" +
                       link("b", pose("same", "")) + link("c", pose("high", "1 0 0 0 0 0")));
  expect_near(m->find_link("b")->X_ML.p, {1, 0.5, 0});
  expect_near(m->find_link("c")->X_ML.p, {1, 0, 2});
}

TEST_F(SdfFramesTest, AJointIsInItsChildUnlessItSaysOtherwise) {
  const std::string links = link("a") + link("b", "<pose>" + turned("1 0 0") + "</pose>");
  const auto plain = model(links + fixed("a", "b", "<pose>1 0 0 0 0 0</pose>"));
  expect_near(plain->joints[0].X_CJ.p, {1, 0, 0});
  // The pose of the model's origin in the turned link's frame.
  const auto other = model(links + fixed("a", "b", pose("__model__", "0 0 0 0 0 0")));
  expect_near(other->joints[0].X_CJ.p, {0, 1, 0});
}

TEST_F(SdfFramesTest, ALinkMayBePlacedInTheJointThatHoldsAnother) {
  const auto m =
      model(link("a") + link("b", "<pose>1 0 0 0 0 0</pose>") +
            fixed("a", "b", "<pose>0 0 1 0 0 0</pose>") + link("c", pose("j_b", "0 1 0 0 0 0")));
  expect_near(m->find_link("c")->X_ML.p, {1, 1, 1});
}

TEST_F(SdfFramesTest, AJointHoldsTheLinkThatItsFrameMovesWith) {
  const auto m = model(link("a") + link("b", "<pose>1 0 0 0 0 0</pose>") +
                       "<frame name='socket' attached_to='a'><pose>0 0 1 0 0 0</pose></frame>"
                       "<frame name='plug' attached_to='b'><pose>0 0.5 0 0 0 0</pose></frame>"
                       "<frame name='deep' attached_to='plug'/>" +
                       fixed("socket", "deep", "<pose>0 0 0.25 0 0 0</pose>"));
  EXPECT_EQ(m->joints[0].parent, "a");
  EXPECT_EQ(m->joints[0].child, "b");
  expect_near(m->joints[0].X_CJ.p, {0, 0.5, 0.25});
}

TEST_F(SdfFramesTest, AnAxisIsTurnedFromTheFrameThatItIsGivenIn) {
  const auto m =
      model(link("a") + link("b") + "<frame name='f'><pose>" + turned("5 5 5") + "</pose></frame>" +
            "<joint name='j' type='revolute'><parent>a</parent><child>b</child>"
            "<axis><xyz expressed_in='f'>1 0 0</xyz></axis></joint>");
  expect_near(m->joints[0].axis.axis, {0, 1, 0});
}

TEST_F(SdfFramesTest, WhatALinkHoldsMayBePlacedElsewhere) {
  const auto m =
      model("<frame name='mast'><pose>0 0 2 0 0 0</pose></frame>" +
            link("a", "<pose>" + turned("1 0 0") + "</pose>" + "<inertial>" +
                          pose("mast", "0 0 0 0 0 0") + "<mass>1</mass></inertial>" +
                          "<collision name='c'>" + pose("mast", "0 0 0 0 0 0") +
                          "<geometry><sphere><radius>1</radius></sphere></geometry></collision>"
                          "<visual name='v'>" +
                          pose("a", "7 0 0 0 0 0") +
                          "<geometry><sphere><radius>1</radius></sphere></geometry></visual>"
                          "<sensor name='s' type='imu'>" +
                          pose("__model__", "1 1 0 0 0 0") + "</sensor>"));
  const Link& a = m->links[0];
  expect_near(a.inertial->X_LI.p, {0, 1, 2});
  expect_near(a.collisions[0].X_LC.p, {0, 1, 2});
  expect_near(a.visuals[0].X_LV.p, {7, 0, 0});
  expect_near(a.sensors[0].X_LS.p, {1, 0, 0});
}

TEST_F(SdfFramesTest, ANestedModelIsPlacedAndItsLinksPlaceOthers) {
  const std::string nested = "<model name='n'>" + pose("a", "1 0 0 0 0 0") +
                             link("tip", "<pose>0 0 1 0 0 0</pose>") + "</model>";
  const auto m = model(link("a", "<pose>" + turned("1 0 0") + "</pose>") + nested +
                       "<model name='k'>" + pose("n::tip", "0 0 1 0 0 0") + link("l") + "</model>" +
                       fixed("a", "n::tip", pose("n::tip", "0 0 3 0 0 0")));
  expect_near(m->find_link("n::tip")->X_ML.p, {1, 1, 1});
  expect_near(m->find_link("k::l")->X_ML.p, {1, 1, 2});
  expect_near(m->joints[0].X_CJ.p, {0, 0, 3});
}

TEST_F(SdfFramesTest, ModelsOfAWorldArePlacedInEachOther) {
  folder_.write(
      "box/model.sdf",
      "<sdf version='1.7'><model name='box'><link name='lid'><pose>0 0 1 0 0 0</pose></link>"
      "</model></sdf>");
  const std::string uri = "<uri>model://box</uri>";
  const World w = world("<frame name='yard'><pose>" + turned("10 0 0") + "</pose></frame>" +
                        "<model name='m'>" + pose("first", "1 0 0 0 0 0") + link("l") + "</model>" +
                        "<include>" + uri + "<name>first</name>" + pose("yard", "1 0 0 0 0 0") +
                        "</include>" + "<include>" + uri + "<name>second</name>" +
                        pose("first::lid", "0 0 1 0 0 0") + "</include>");
  expect_near(w.models[0].pose.p, {10, 2, 0});
  expect_near(w.models[1].pose.p, {10, 1, 0});
  expect_near(w.models[2].pose.p, {10, 1, 2});
}

TEST_F(SdfFramesTest, APlacedModelIsWhereItIsForWhatComesBeforeItToo) {
  const std::string parts = link("base") + link("tip", "<pose>1 0 0 0 0 0</pose>");
  folder_.write("arm/model.sdf", "<sdf version='1.8'><model name='arm'><pose>0 0 7 0 0 0</pose>" +
                                     parts + "</model></sdf>");
  const auto arm = [](const std::string& more) {
    return "<include><uri>model://arm</uri>" + more + "</include>";
  };
  const std::string placed = "<pose>5 0 0 0 0 0</pose><placement_frame>tip</placement_frame>";
  const auto tool = [&](const std::string& in, const std::string& after) {
    return model(link("tool", pose(in, "0 0 1 0 0 0")) + after)->links.at(0).X_ML.p;
  };
  expect_near(tool("arm", arm(placed)), {4, 0, 1});
  expect_near(tool("arm::tip", arm(placed)), {5, 0, 1});
  expect_near(tool("arm", arm("")), {0, 0, 8});
  expect_near(tool("a::tip", arm("<name>a</name>")), {1, 0, 8});
  const World w = world("<model name='first'>" + pose("b", "0 0 1 0 0 0") + link("l") +
                        "</model><model name='second'>" + pose("b::base", "0 0 2 0 0 0") +
                        link("l") + "</model><model name='b' placement_frame='tip'>" +
                        "<pose>5 0 0 0 0 0</pose>" + parts + "</model>");
  expect_near(w.models.at(0).pose.p, {4, 0, 1});
  expect_near(w.models.at(1).pose.p, {4, 0, 2});
  expect_near(w.models.at(2).pose.p, {4, 0, 0});
}

TEST_F(SdfFramesTest, AModelInANestedModelIsAFrame) {
  const std::string nested = "<model name='a'><pose>1 0 0 0 0 0</pose>" + link("x") +
                             "<model name='b'><pose>0 1 0 0 0 0</pose>" + link("y") +
                             "</model></model>";
  const auto m = model(link("t", pose("a::b", "0 0 1 0 0 0")) + nested + fixed("a::b", "t"));
  expect_near(m->find_link("t")->X_ML.p, {1, 1, 1});
  EXPECT_EQ(m->joints.at(0).parent, "a::b::y");
  const World w =
      world("<model name='c'>" + pose("a::b", "0 0 1 0 0 0") + link("l") + "</model>" + nested +
            "<model name='s'><static>1</static><model name='d'>" + "<pose>0 3 0 0 0 0</pose>" +
            link("y", "<pose>0 0 1 0 0 0</pose>") + "</model></model><model name='e'>" +
            pose("s::d::y", "1 0 0 0 0 0") + link("l") + "</model>");
  expect_near(w.models.at(0).pose.p, {1, 1, 1});
  expect_near(w.models.at(3).pose.p, {1, 3, 1});
}

TEST_F(SdfFramesTest, AFrameAttachedToNothingIsTheModels) {
  const auto m =
      model(link("a", "<pose>1 0 0 0 0 0</pose>") + link("b") +
            "<frame name='f' attached_to=''><pose>0 0 1 0 0 0</pose></frame>" + fixed("f", "b"));
  expect_near(m->find_frame("f")->X_MF.p, {0, 0, 1});
  EXPECT_EQ(m->joints.at(0).parent, "a");
}

TEST_F(SdfFramesTest, ALampStandsInAFrame) {
  const World w = world(
      "<frame name='f'><pose>1 2 3 0 0 0</pose></frame><light name='l' "
      "type='point'>" +
      pose("f", "0 0 1 0 0 0") + "</light>");
  expect_near(w.lights.at(0).pose.p, {1, 2, 4});
}

TEST_F(SdfFramesTest, TheCanonicalLinkMayBeNamed) {
  EXPECT_EQ(model(link("a") + link("b"))->canonical_link, "a");
  const auto named = [this](const std::string& name) {
    return loader_.load_model_text("<sdf version='1.7'><model name='m' canonical_link='" + name +
                                       "'>" + link("a") + link("b") + "</model></sdf>",
                                   "test.sdf");
  };
  EXPECT_EQ(named("b")->canonical_link, "b");
  EXPECT_HAS(error_of([&] { named("c"); }), "found link 'c', expected one of");
}

TEST_F(SdfFramesTest, DegreesAreTurnedIntoRadians) {
  const auto m = model(link("a", "<pose degrees='true'>0 0 0 0 0 90</pose>"));
  expect_near(m->links[0].X_ML.q * Eigen::Vector3d::UnitX(), {0, 1, 0});
  EXPECT_HAS(error_of([&] { model(link("a", "<pose degrees='yes'>0 0 0 0 0 90</pose>")); }),
             "<pose>: found 'yes'");
}

TEST_F(SdfFramesTest, APoseMayHoldAQuaternionOrDegrees) {
  const auto turned = [&](const std::string& attributes, const std::string& numbers) {
    return model("<link name='a'><pose " + attributes + ">" + numbers + "</pose></link>")
        ->links.at(0)
        .X_ML;
  };
  for (const Pose& X_ML : {turned("degrees='true'", "1 2 3 0 0 90"),
                           turned("rotation_format='euler_rpy' degrees='1'", "1 2 3 0 0 90"),
                           turned("rotation_format='quat_xyzw'", "1 2 3 0 0 2 2")}) {
    expect_near(X_ML * Eigen::Vector3d(1, 0, 0), {1, 3, 3});
  }
  EXPECT_HAS(error_of([&] { turned("rotation_format='quat_xyzw'", "1 2 3 0 0 1"); }),
             "expected seven finite numbers");
  EXPECT_HAS(error_of([&] { turned("rotation_format='quat_xyzw'", "1 2 3 0 0 0 0"); }),
             "found a quaternion of length zero");
  EXPECT_HAS(error_of([&] { turned("rotation_format='matrix'", "1 2 3 0 0 0"); }),
             "found rotation_format='matrix'");
}

TEST_F(SdfFramesTest, NamesWhatIsWrong) {
  EXPECT_HAS(error_of([&] { model(link("a", pose("b", "")) + link("b", pose("a", ""))); }),
             "lies in itself");
  EXPECT_HAS(error_of([&] { model(link("a", pose("x", ""))); }),
             "<pose>: found frame 'x', expected one of __model__, a");
  EXPECT_HAS(
      error_of([&] { model("<frame name='f' attached_to='f'/>" + link("a") + fixed("a", "f")); }),
      "found that frame 'f' lies in itself");
  EXPECT_HAS(error_of([&] { world("<model name='m'>" + pose("x", "") + link("a") + "</model>"); }),
             "found frame 'x', expected one of m, world");
  // Without known frames, only the pose of a file's own model counts.
  EXPECT_HAS(error_of([&] {
               loader_.load_model_text("<sdf version='1.7'><model name='m'>" +
                                           pose("x", "0 0 0 0 0 0") + link("a") + "</model></sdf>",
                                       "test.sdf");
             }),
             "found relative_to='x', expected none here");
}

TEST_F(SdfFramesTest, AnAbsurdlyDeepChainIsRefused) {
  std::string frames = "<frame name='f0'/>";
  for (int k = 1; k <= 100'000; ++k) {
    frames +=
        "<frame name='f" + std::to_string(k) + "' attached_to='f" + std::to_string(k - 1) + "'/>";
  }
  EXPECT_HAS(error_of([&] { model(frames + link("a", pose("f100000", ""))); }), "expected fewer");
  EXPECT_HAS(error_of([&] { model(frames + link("a") + fixed("a", "f100000")); }), "found link 'f");
  expect_near(model(frames + link("a", pose("f900", "1 0 0 0 0 0")))->links[0].X_ML.p, {1, 0, 0});
}

TEST_F(SdfFramesTest, GazebosNewestVersionIsReadWithoutAWarning) {
  model(link("a"));
  EXPECT_TRUE(warnings_->empty());
  ReadersTest::model(link("a"), "1.12");
  EXPECT_TRUE(warnings_->empty());
  ReadersTest::model(link("a"), "1.13");
  EXPECT_TRUE(warned("found version 1.13, read as SDF 1.12"));
}

}  // namespace
}  // namespace ardee
