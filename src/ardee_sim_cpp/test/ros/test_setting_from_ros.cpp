// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/core/error.h"
#include "ros/setting_from_ros.h"

namespace ardee::node {
namespace {

TEST(SettingFromRos, KeepsTypesAndNamesPaths) {
  XmlRpc::XmlRpcValue base;
  base["rate"] = 50;
  base["radius"] = 0.1;
  base["open_loop"] = true;
  base["wheel"] = "left";
  base["linear"]["x"]["max_velocity"] = 1.5;
  base["covariance"][0] = 0.5;
  base["covariance"][1] = 2;
  const Setting setting = to_setting("/robot/base", base);
  EXPECT_EQ(std::get<int>(setting.at("rate").value()), 50);
  EXPECT_EQ(std::get<double>(setting.at("radius").value()), 0.1);
  EXPECT_TRUE(std::get<bool>(setting.at("open_loop").value()));
  EXPECT_EQ(setting.text("wheel"), "left");
  EXPECT_EQ(setting.number("linear/x/max_velocity"), 1.5);
  EXPECT_EQ(setting.at("linear/x/max_velocity").path(), "/robot/base/linear/x/max_velocity");
  const auto covariance = std::get<Setting::List>(setting.at("covariance").value());
  EXPECT_EQ(std::get<double>(covariance.at(0).value()), 0.5);
  EXPECT_EQ(std::get<int>(covariance.at(1).value()), 2);
  EXPECT_EQ(covariance.at(1).path(), "/robot/base/covariance[1]");
}

TEST(SettingFromRos, HasNothingOfAnEmptyValueAndRefusesBytes) {
  XmlRpc::XmlRpcValue nothing;
  EXPECT_FALSE(to_setting("/x", nothing));
  char bytes[] = "abc";
  XmlRpc::XmlRpcValue binary(bytes, 3);
  EXPECT_THROW(to_setting("/x", binary), Error);
}

}  // namespace
}  // namespace ardee::node
