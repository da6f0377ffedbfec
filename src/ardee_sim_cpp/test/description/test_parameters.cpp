// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "ardee_sim/description/parameters.h"

namespace ardee {
namespace {

Element block(const std::vector<std::pair<std::string, std::string>>& keys) {
  Element element;
  element.name = "plugin";
  element.source = {"robot.urdf", 10, "plugin"};
  int line = 11;
  for (const auto& [name, text] : keys) {
    Element child;
    child.name = name;
    child.text = text;
    child.source = {"robot.urdf", line++, name};
    element.children.push_back(child);
  }
  return element;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, ReadsTypedValuesAndDefaults) {
  const Element element = block({{"rate", " 50.0 "}, {"tf", "TRUE"}, {"gain", "1 -2.5 +3e2"}});
  Parameters parameters(element);
  EXPECT_EQ(parameters.number("rate", 1.0), 50.0);
  EXPECT_TRUE(parameters.boolean("tf", false));
  EXPECT_EQ(parameters.vector3("gain", Eigen::Vector3d::Zero()), Eigen::Vector3d(1, -2.5, 300));
  EXPECT_EQ(parameters.number("absent", 4.5), 4.5);
}

TEST(Parameters, ABadValueSaysFileLineElementFoundExpected) {
  for (const char* bad : {"fast", "nan", "inf", "1e999", "1 2", "0x10", "1,5", "+-1", "1ff"}) {
    const Element element = block({{"rate", bad}});
    const std::string message = message_of([&] { Parameters(element).number("rate", 1.0); });
    EXPECT_EQ(message,
              "robot.urdf:11: <rate>: found '" + std::string(bad) + "', expected a finite number");
  }
}

TEST(Parameters, AnEmptyValueIsTheDefault) {
  const Element element = block({{"rate", ""}, {"tf", ""}, {"gain", ""}});
  Parameters parameters(element);
  EXPECT_EQ(parameters.number("rate", 20.0), 20.0);
  EXPECT_EQ(parameters.integer("rate", 20, 0, 100), 20);
  EXPECT_TRUE(parameters.boolean("tf", true));
  EXPECT_EQ(parameters.vector3("gain", {1, 2, 3}), Eigen::Vector3d(1, 2, 3));
}

TEST(Parameters, AFloatMayHaveItsSuffix) {
  EXPECT_EQ(parse_number("0.5f", {}), 0.5);
  EXPECT_EQ(parse_number("2F", {}), 2.0);
  EXPECT_EQ(*to_double("Inf"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(*to_double("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(*to_double("NaN")));
  EXPECT_FALSE(to_double("f"));
}

TEST(Parameters, AValueOutOfBoundsIsRefused) {
  const Element element = block({{"rate", "-1"}});
  EXPECT_EQ(message_of([&] { Parameters(element).number("rate", 1.0, 0.0, 100.0); }),
            "robot.urdf:11: <rate>: found -1, expected a number in [0, 100]");
  EXPECT_EQ(message_of([&] { Parameters(element).number("rate", 1.0, 0.0); }),
            "robot.urdf:11: <rate>: found -1, expected a number of at least 0");
}

TEST(Parameters, AMissingRequiredKeyIsNamed) {
  const Element element = block({});
  EXPECT_EQ(message_of([&] { Parameters(element).required_text("joint"); }),
            "robot.urdf:10: <plugin>: found no <joint>, expected one");
}

TEST(Parameters, AMisspeltKeyIsReportedOnce) {
  const Element element = block({{"rate", "1"}, {"updateRat", "5"}, {"gz:system", "of another"}});
  std::vector<std::string> warnings;
  Log log([&](LogLevel, const std::string& text) { warnings.push_back(text); });
  Parameters parameters(element);
  parameters.number("rate", 0.0);
  parameters.finish(log);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "robot.urdf:12: <updateRat>: unknown key, ignored");
}

TEST(Parameters, AValueThatComesAgainIsReportedButNotAList) {
  const Element element = block({{"rate", "1"}, {"rate", "5"}, {"plot", "2"}, {"plot", "3"}});
  std::vector<std::string> warnings;
  Log log([&](LogLevel, const std::string& text) { warnings.push_back(text); });
  Parameters parameters(element);
  EXPECT_EQ(parameters.number("rate", 0.0), 1.0);
  EXPECT_NE(parameters.block("plot"), nullptr);
  parameters.finish(log);
  EXPECT_EQ(warnings, std::vector<std::string>{
                          "robot.urdf:12: <rate>: found it a second time, expected it once: the "
                          "first counts"});
}

TEST(Parameters, TakesDownWhichKeysAreAskedFor) {
  Element element;
  element.key_log = std::make_shared<KeyLog>();
  Parameters parameters(element);
  parameters.block("rate");
  parameters.number("rate", 2.5);
  parameters.boolean("on", true);
  EXPECT_THROW(parameters.required_text("name"), Error);
  parameters.ignore({"alwaysOn"});
  const std::vector<AskedKey>& keys = element.key_log->keys();
  ASSERT_EQ(keys.size(), 4u);
  EXPECT_EQ(keys[0].name + " " + keys[0].kind + " " + keys[0].fallback, "rate number 2.5");
  EXPECT_EQ(keys[1].fallback, "true");
  EXPECT_TRUE(keys[2].is_required);
  EXPECT_TRUE(keys[3].is_ignored && !keys[0].is_ignored);
}

}  // namespace
}  // namespace ardee
