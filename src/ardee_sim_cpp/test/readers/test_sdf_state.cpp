// SPDX-License-Identifier: MIT
// Tests of worlds as Gazebo saves them, with all poses in <state>.
#include "fixture.h"

namespace ardee {
namespace {

using SdfState = ReadersTest;

constexpr char kBox[] =
    "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>";

std::string model_of(const std::string& name, const std::string& links,
                     const std::string& more = "") {
  return "<model name='" + name + "'>" + more + links + "</model>";
}
std::string state_of(const std::string& body) {
  return "<state world_name='w'>" + body + "</state>";
}

TEST_F(SdfState, ModelsStandWhereTheyWere) {
  const std::string link = "<link name='l'/></model>";
  const World w = world("<model name='a'><pose>1 2 3 0 0 0</pose>" + link +
                        "<model name='b'><pose>4 5 6 0 0 0</pose>" + link +
                        "<state world_name='w'><sim_time>3 5</sim_time><model name='a'>"
                        "<pose frame=''>7 8 9 0 -0 1.5707963267948966</pose><scale>1 1 1</scale>"
                        "<link name='l'><pose frame=''>7 8 9 0 0 0</pose></link></model>"
                        "<model name='gone'><pose>0 0 0 0 0 0</pose></model></state>");
  expect_near(w.models.at(0).pose.p, {7, 8, 9});
  expect_near(w.models.at(0).pose * Eigen::Vector3d(1, 0, 0), {7, 9, 9});
  expect_near(w.models.at(1).pose.p, {4, 5, 6});
  EXPECT_EQ(warnings_->size(), 1u);
  EXPECT_TRUE(warned("model 'gone'"));
}

TEST_F(SdfState, AMovingModelsLinksAreKeptAsTheyWereSaved) {
  const std::string links = "<link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose></link>";
  const World w = world(
      model_of("m", links) +
      state_of("<model name='m'><pose>0 0 2 0 0 0</pose>"
               "<link name='a'><pose>0 0 2 0 0 0</pose><velocity>0 0 0 0 -0 0</velocity></link>"
               "<link name='b'><pose>0 1 2 0 0 1.5707963</pose>"
               "<velocity>1 2 3 0.4 0.5 0.6</velocity><acceleration>0 0 -9.8 0 0 0</acceleration>"
               "<wrench>0 0 -9.8 0 0 0</wrench></link></model>"));
  expect_near(w.models.at(0).pose.p, {0, 0, 2});
  const LinkStates& states = *w.models.at(0).link_states;
  expect_near(states.at("a").X_WL.p, {0, 0, 2});
  expect_near(states.at("b").X_WL.p, {0, 1, 2});
  expect_near(states.at("b").X_WL.q * Eigen::Vector3d::UnitX(), {0, 1, 0}, 1e-7);
  expect_near(states.at("b").twist_W.linear, {1, 2, 3});
  expect_near(states.at("b").twist_W.angular, {0.4, 0.5, 0.6});
  expect_near(w.models.at(0).model->links.at(1).X_ML.p, {1, 0, 0});  // the description stays
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SdfState, LinksThatStandAsDescribedNeedNoState) {
  const World w =
      world(model_of("m", "<link name='a'><pose>1 0 0 0 0 0</pose></link>") +
            state_of("<model name='m'><pose>100 0 0 0 0 1.5707963</pose>"
                     "<link name='a'><pose>100 1.00001 0 0 -0 1.5708</pose></link></model>"));
  EXPECT_EQ(w.models.at(0).link_states, nullptr);
}

TEST_F(SdfState, TwoRobotsOfOneDescriptionHaveStatesOfTheirOwn) {
  const std::string links = "<link name='a'/>";
  const World w = world(model_of("one", links) + model_of("two", links) +
                        state_of("<model name='two'><link name='a'><pose>5 0 0 0 0 0</pose></link>"
                                 "</model><model name='one'><link name='a'><pose>4 0 0 0 0 0</pose>"
                                 "</link></model>"));
  expect_near(w.models.at(0).link_states->at("a").X_WL.p, {4, 0, 0});
  expect_near(w.models.at(1).link_states->at("a").X_WL.p, {5, 0, 0});
}

TEST_F(SdfState, AStaticModelsLinksMoveInACopyOfItsDescription) {
  const std::string links = "<link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose></link>";
  const World w = world(model_of("m", links, "<static>1</static>") +
                        state_of("<model name='m'><pose>2 0 0 0 0 1.5707963267948966</pose>"
                                 "<link name='b'><pose>2 3 0 0 0 0</pose></link></model>"));
  const Instance& m = w.models.at(0);
  EXPECT_EQ(m.link_states, nullptr);
  expect_near((m.pose * m.model->links.at(1).X_ML).p, {2, 3, 0});
  expect_near(m.model->links.at(0).X_ML.p, {0, 0, 0});
}

TEST_F(SdfState, NestedModelsStandInTheWorldsFrame) {
  const std::string nested =
      "<model name='n'><link name='b'><pose>1 0 0 0 0 0</pose></link></model>";
  const std::string saved =
      "<model name='n'><pose>3 0 7 0 0 0</pose><link name='b'><pose>4 0 7 0 0 0</pose></link>"
      "</model>";
  const World w = world(model_of("moving", "<link name='a'/>" + nested) +
                        model_of("still", "<link name='a'/>" + nested, "<static>1</static>") +
                        state_of("<model name='moving'>" + saved +
                                 "</model><model name='still'><pose>0 0 5 0 0 "
                                 "0</pose>" +
                                 saved + "</model>"));
  expect_near(w.models.at(0).link_states->at("n::b").X_WL.p, {4, 0, 7});
  const Instance& still = w.models.at(1);
  expect_near((still.pose * still.model->instances.at(0).pose).p, {3, 0, 7});
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SdfState, ScaleMakesShapesLarger) {
  const World w = world(
      model_of("m", "<link name='a'><pose>1 0 0 0 0 0</pose>" + std::string(kBox) + "</link>") +
      state_of("<model name='m'><scale>2 1 0.5</scale></model>"));
  const Link& link = w.models.at(0).model->links.at(0);
  expect_near(std::get<Box>(link.collisions.at(0).geometry).size_m, {2, 2, 1.5});
  expect_near(link.X_ML.p, {1, 0, 0});
}

TEST_F(SdfState, TheClockStartsAtTheSavedTime) {
  EXPECT_EQ(world(state_of("<sim_time>54 250000000</sim_time>")).start_ns, 54'250'000'000);
  EXPECT_EQ(world("").start_ns, 0);
  EXPECT_HAS(error_of([&] { world(state_of("<sim_time>-1 0</sim_time>")); }),
             "<sim_time>: found '-1 0', expected seconds and nanoseconds");
  EXPECT_HAS(error_of([&] { world(state_of("<sim_time>1 2 3</sim_time>")); }), "expected seconds");
}

TEST_F(SdfState, InsertionsAreAddedAndDeletionsTakenOut) {
  const World w = world(
      model_of("a", "<link name='l'/>") + model_of("b", "<link name='l'/>") +
      "<light name='sun' type='point'/>" +
      state_of("<insertions>" + model_of("new", "<link name='l'/>", "<pose>1 2 3 0 0 0</pose>") +
               model_of("a", "<link name='other'/>") + "<light name='lamp' type='point'/>" +
               "</insertions><deletions><name>b</name><name>sun</name></deletions>"));
  ASSERT_EQ(w.models.size(), 2u);
  EXPECT_EQ(w.models.at(0).model->links.at(0).name, "l");
  EXPECT_EQ(w.models.at(1).name, "new");
  expect_near(w.models.at(1).pose.p, {1, 2, 3});
  ASSERT_EQ(w.lights.size(), 1u);
  EXPECT_EQ(w.lights.at(0).name, "lamp");
  EXPECT_EQ(warnings_->size(), 1u);
  EXPECT_TRUE(warned("<model>: found in the world already, left out: 'a'"));
}

TEST_F(SdfState, LightsStandWhereTheyWere) {
  const World w = world("<light name='lamp' type='point'/>" +
                        state_of("<light name='lamp'><pose>1 2 3 0 0 0</pose></light>"));
  expect_near(w.lights.at(0).pose.p, {1, 2, 3});
}

TEST_F(SdfState, OneWarningNamesWhatTheWorldDoesNotHave) {
  world(model_of("m", "<link name='l'/>") +
        state_of("<model name='m'><link name='x'/><model name='n'/></model><model name='gone'/>"
                 "<light name='dark'/><deletions><name>p</name><name>q</name></deletions>"));
  ASSERT_EQ(warnings_->size(), 1u);
  EXPECT_EQ(warnings_->at(0),
            "test.world:1: <state>: found link 'm::x', model 'm::n', model 'gone', light 'dark', "
            "entity 'p' and 1 more, which the world does not have; ignored");
}

TEST_F(SdfState, TheFirstOfSeveralCounts) {
  EXPECT_EQ(
      world(state_of("<sim_time>1 0</sim_time>") + state_of("<sim_time>2 0</sim_time>")).start_ns,
      1'000'000'000);
  EXPECT_TRUE(warned("<state>: found a second <state>, the first counts"));
}

TEST_F(SdfState, TheFirstStateOfAModelCounts) {
  const World w = world(model_of("m", "<link name='l'/>") +
                        state_of("<model name='m'><pose>1 0 0 0 0 0</pose></model>"
                                 "<model name='m'><pose>2 0 0 0 0 0</pose></model>"));
  expect_near(w.models.at(0).pose.p, {1, 0, 0});
  EXPECT_TRUE(warned("<model>: found a second state of one name, the first counts"));
}

TEST_F(SdfState, RefusesWhatHasNoMeaning) {
  const std::string m = model_of("m", "<link name='l'/>");
  const auto refused = [&](const std::string& saved) {
    return error_of([&] { world(m + state_of("<model name='m'>" + saved + "</model>")); });
  };
  EXPECT_HAS(refused("<scale>1 0 1</scale>"), "<scale>: found '1 0 1', expected three positive");
  EXPECT_HAS(refused("<link name='l'><pose>nan 0 0 0 0 0</pose></link>"), "expected six finite");
  EXPECT_HAS(refused("<link name='l'><pose/><velocity>1 2</velocity></link>"), "expected six");
}

}  // namespace
}  // namespace ardee
