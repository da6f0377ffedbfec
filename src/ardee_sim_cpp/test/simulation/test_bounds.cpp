// SPDX-License-Identifier: MIT
// Tests that the physics accepts whatever the readers accept; the readers refuse the rest, with its
// place in the file.
#include <gtest/gtest.h>

#include "effects.h"
#include "fixture.h"

namespace ardee {
using namespace raycast;
namespace {

/// World with one number, `{}`, in it.
struct Number {
  std::string world;
  std::vector<std::string> taken;
  std::vector<std::string> refused;
};

std::string in_surface(const std::string& text) {
  return in_model("m", in_link(collision(kCube, "<surface>" + text + "</surface>")));
}

const std::vector<Number>& numbers() {
  static const auto contact = [](const std::string& name) {
    const std::string element = "<" + name + ">{}</" + name + ">";
    return in_surface("<contact><ode>" + element + "</ode></contact>");
  };
  static const auto friction = [](const std::string& name) {
    const std::string element = "<" + name + ">{}</" + name + ">";
    return in_surface("<friction><ode>" + element + "</ode></friction>");
  };
  static const auto of_world = [](const std::string& ode) {
    return "<physics type='ode' default='1'><ode>" + ode + "</ode></physics>" +
           in_model("m", in_link(collision(kCube)));
  };
  static const std::vector<Number> all{
      {contact("max_vel"), {"-1", "0", "100", "inf"}, {"nan", "fast"}},
      {contact("min_depth"), {"-1", "0", "0.01"}, {"inf", "1e10"}},
      {contact("kp"), {"0", "1e30", "Inf"}, {"-1"}},
      {contact("kd"), {"0", "1e30", "Inf"}, {"-1"}},
      {friction("mu"), {"-1", "0", "1e30", "Inf"}, {"nan"}},
      {friction("slip1"), {"0", "1e9"}, {"-1", "1e10"}},
      {of_world("<solver><sor>{}</sor></solver>"), {"1e-6", "2"}, {"0", "2.1"}},
      {of_world("<solver><iters>{}</iters></solver>"), {"1", "100000"}, {"0", "100001"}},
      {of_world("<constraints><cfm>{}</cfm></constraints>"), {"0", "1e6"}, {"-1", "2e6"}},
      {of_world("<constraints><erp>{}</erp></constraints>"), {"0", "1"}, {"-0.1", "1.1"}},
      {of_world("<constraints><contact_max_correcting_vel>{}</contact_max_correcting_vel></"
                "constraints>"),
       {"0", "inf"},
       {"-1"}},
      {of_world("<constraints><contact_surface_layer>{}</contact_surface_layer></constraints>"),
       {"0", "0.1"},
       {"-0.1"}},
      {in_model("m", in_link("<velocity_decay><linear>{}</linear></velocity_decay>")),
       {"0", "1"},
       {"-0.1", "1.1"}}};
  return all;
}

std::string error_of(std::string world, const std::string& value) {
  world.replace(world.find("{}"), 2, value);
  try {
    TestWorld made(world);
    made.run(0.002);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Bounds, PhysicsTakesWhatReadersTake) {
  for (const Number& number : numbers()) {
    for (const std::string& value : number.taken) {
      EXPECT_EQ(error_of(number.world, value), "") << number.world << ", " << value;
    }
  }
}

TEST(Bounds, WhatIsRefusedIsRefusedAtItsLine) {
  for (const Number& number : numbers()) {
    for (const std::string& value : number.refused) {
      const std::string error = error_of(number.world, value);
      EXPECT_NE(error.find("test.world:1: <"), std::string::npos) << number.world << value << error;
      EXPECT_NE(error.find("found '" + value + "'"), std::string::npos) << error;
    }
  }
}

}  // namespace
}  // namespace ardee
