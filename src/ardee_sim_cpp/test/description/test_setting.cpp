// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/setting.h"

namespace ardee {
namespace {

Setting base() {
  const std::string path = "/robot/base";
  const auto value = [&](const std::string& name, Setting::Value each) {
    return Setting(path + "/" + name, std::move(each));
  };
  return {path,
          Setting::Map{{"radius", value("radius", 0.1)},
                       {"rate", value("rate", 50)},
                       {"tf", value("tf", true)},
                       {"type", value("type", std::string("Drive"))},
                       {"linear/x", value("linear/x", Setting::Map{{"max", value("max", 1.0)}})},
                       {"linear", value("linear", Setting::Map{{"y", value("y", 2.0)}})},
                       {"wheels", value("wheels", Setting::List{{"w", std::string("a")}})},
                       {"sizes", value("sizes", Setting::List{{"s", 1.0}, {"s", 2}})}}};
}

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Setting, GivesWhatItIsAskedForOfItsType) {
  const Setting setting = base();
  EXPECT_EQ(setting.number("radius"), 0.1);
  EXPECT_EQ(setting.number("rate"), 50.0);
  EXPECT_EQ(setting.integer("rate", 7), 50);
  EXPECT_TRUE(setting.boolean("tf", false));
  EXPECT_EQ(setting.text("type"), "Drive");
  EXPECT_EQ(setting.number("no", 3.0), 3.0);
  EXPECT_EQ(setting.texts("wheels"), std::vector<std::string>{"a"});
  EXPECT_FALSE(setting.has("no/such"));
}

TEST(Setting, FindsAPathHoweverItsKeysWereWritten) {
  EXPECT_EQ(base().number("linear/x/max"), 1.0);
  EXPECT_EQ(base().number("linear/y"), 2.0);
}

TEST(Setting, SaysWhereWhatItFoundAndWhatItExpected) {
  EXPECT_EQ(message_of([] { base().number("width"); }),
            "/robot/base/width: found nothing, expected a number");
  EXPECT_EQ(message_of([] { base().number("type"); }),
            "/robot/base/type: found 'Drive', expected a number");
  EXPECT_EQ(message_of([] { base().integer("radius", 1); }),
            "/robot/base/radius: found the number 0.100000, expected an integer");
  EXPECT_EQ(message_of([] { base().boolean("rate", false); }),
            "/robot/base/rate: found the integer 50, expected true or false");
  EXPECT_EQ(message_of([] { base().exact_doubles("sizes", 2); }),
            "s: found the integer 2, expected a number with a point, as 0.0 or 1.0e6");
}

}  // namespace
}  // namespace ardee
