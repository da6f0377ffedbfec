// SPDX-License-Identifier: MIT
// Tests that short descriptions of much work are read quickly or refused at once.
#include <chrono>

#include "fixture.h"

namespace ardee {
namespace {

using Large = ReadersTest;

/// Limit of time: ten times the need of a slow machine. Work that grows with the square takes far
/// longer.
constexpr double kAtOnce_s = 10.0;

template <typename Action>
double seconds_of(Action action) {
  const auto start = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string chain(int links, const std::string& type, const std::string& in_link,
                  const std::string& in_joint = "") {
  std::string text;
  for (int i = 0; i < links; ++i) {
    const std::string number = std::to_string(i);
    text += "<link name='l" + number + "'>" + in_link + "</link>\n";
    if (i == 0) continue;
    text += "<joint name='j" + number + "' type='" + type + "'><parent link='l" +
            std::to_string(i - 1) + "'/><child link='l" + number +
            "'/><origin xyz='0 0 0.001'/></joint>" + "<gazebo reference='l" + number +
            "'><selfCollide>0</selfCollide></gazebo>" + in_joint;
  }
  return text;
}

const std::string kMass =
    "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
    "izz='1'/></inertial>";

TEST_F(Large, AChainOfTwentyThousandLinksIsReadInProportionToItsLength) {
  for (const std::string& text : {chain(20'000, "fixed", kMass), chain(20'000, "fixed", ""),
                                  chain(20'000, "continuous", kMass),
                                  "<link name='heavy'>" + kMass +
                                      "</link><joint name='j' type='fixed'><parent link='heavy'/>"
                                      "<child link='l0'/></joint>" +
                                      chain(20'000, "continuous", "")}) {
    std::shared_ptr<const Model> model;
    EXPECT_LT(seconds_of([&] { model = robot(text); }), kAtOnce_s);
    EXPECT_NEAR(model->find_link("l19999")->X_ML.p.z(), 19.999, 1e-9);
  }
  // The last link has no mass in its direction of motion: one warning for all its joints.
  EXPECT_EQ(warnings_->size(), 1u);
  EXPECT_TRUE(warned("(and 19998 more)"));
}

TEST_F(Large, ALoopOfManyLinksIsRefused) {
  std::string text =
      "<link name='root'/>" + chain(20'000, "fixed", "") +
      "<joint name='back' type='fixed'><parent link='l19999'/><child link='l0'/></joint>";
  EXPECT_LT(seconds_of([&] {
              EXPECT_HAS(error_of([&] { robot(text); }),
                         "found joints in a loop through link 'l0'");
            }),
            kAtOnce_s);
}

TEST_F(Large, ManyRootsAreNamedInAShortMessage) {
  std::string text;
  for (int i = 0; i < 10'000; ++i) text += "<link name='l" + std::to_string(i) + "'/>";
  const std::string error = error_of([&] { robot(text); });
  EXPECT_HAS(error, "found 10000 root links 'l0', 'l1',");
  EXPECT_LT(error.size(), 300u);
}

class LargeIncludes : public ReadersTest {
 protected:
  /// Writes models of which `name``depth` holds ten to the power of `depth` of the innermost, by
  /// includes with `more` in them.
  void nest(const std::string& name, int depth, const std::string& innermost,
            const std::string& more = "") {
    folder_.write_model(name + "0", innermost);
    for (int k = 1; k <= depth; ++k) {
      std::string body = more.empty() ? "<static>1</static>" : "";
      for (int i = 0; i < 10; ++i) {
        body += "<include><uri>model://" + name + std::to_string(k - 1) + "</uri><name>n" +
                std::to_string(i) + "</name>" + more + "</include>";
      }
      folder_.write_model(name + std::to_string(k), body);
    }
  }
  std::string error_of_include(const std::string& name, const std::string& more = "") {
    std::string error;
    EXPECT_LT(seconds_of([&] {
                error = error_of([&] {
                  world("<include><uri>model://" + name + "</uri>" + more + "</include>");
                });
              }),
              kAtOnce_s);
    return error;
  }
};

TEST_F(LargeIncludes, TenMillionStaticModelsInFourKilobytesAreRefused) {
  nest("s", 7, "<static>1</static><link name='l'/>");
  EXPECT_HAS(error_of_include("s7"), "found more than 2000000 static models, expected fewer");
  EXPECT_EQ(error_of_include("s6"), "");
}

TEST_F(LargeIncludes, APluginInAnIncludeHidesNoneOfThem) {
  nest("s", 7, "<static>1</static><link name='l'/>",
       "<static>1</static><plugin name='p' filename='p.so'/>");
  EXPECT_HAS(error_of_include("s7", "<static>1</static>"),
             "found more than 2000000 static models, expected fewer");
}

TEST_F(LargeIncludes, AWorldOfManyCopiesIsRefused) {
  nest("s", 6, "<static>1</static><link name='l'/>");
  const std::string include = "<include><uri>model://s6</uri></include>";
  EXPECT_HAS(error_of([&] { world(include + include + include); }), "2000000 static models");
  EXPECT_HAS(error_of([&] {
               world(
                   "<population name='p'><model name='m'><link name='l'/></model><pose/>"
                   "<box><size>9 9 9</size></box><model_count>200000</model_count>"
                   "<distribution><type>random</type></distribution></population>");
             }),
             "found more than 100000 links of models that move");
}

TEST_F(LargeIncludes, WhatIsMergedMayNotOutgrowTheMemory) {
  nest("s", 6, "<link name='l'/>", "<pose/>");
  EXPECT_HAS(error_of_include("s6"), "found more than 100000 links, expected fewer");
  nest("t", 5,
       "<link name='l'/><plugin name='p' filename='p.so'><a>" + std::string(100'000, 'x') +
           "</a></plugin>",
       "<pose> </pose>");
  EXPECT_HAS(error_of_include("t5"), "takes more than 256 MB");
}

}  // namespace
}  // namespace ardee
