// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "ardee_sim/controllers/pid.h"
#include "ardee_sim/core/error.h"

namespace ardee::control {
using namespace devices;
namespace {

Setting group(const Setting::Map& map) {
  const Setting::Value value(map);
  return {"/robot/pid", value};
}
/// Reads gains from a group, and the only message about it.
PidGains read(const Setting::Map& map, std::string* message = nullptr) {
  Log log([&](LogLevel, const std::string& text) {
    ASSERT_NE(message, nullptr) << text;
    *message = text;
  });
  return read_pid_gains(group(map), log);
}
Setting number(double value) { return {"/robot/pid/x", value}; }

PidGains gains(double p, double i, double d, double clamp = 0.0, bool antiwindup = false) {
  return {p, i, d, -clamp, clamp, antiwindup};
}

TEST(Pid, AnswersAStepByItsThreeTerms) {
  Pid pid(gains(2.0, 4.0, 0.5, 100.0));
  // e = 1 at each 0.1 s: p e = 2, the integral grows by 0.1, the rate is 1 / 0.1 at first.
  EXPECT_DOUBLE_EQ(pid.update(1.0, 0.1), 2.0 + 0.4 + 5.0);
  EXPECT_DOUBLE_EQ(pid.update(1.0, 0.1), 2.0 + 0.8);
  EXPECT_DOUBLE_EQ(pid.update(0.5, 0.1), 1.0 + 1.0 - 2.5);
  pid.reset();
  EXPECT_DOUBLE_EQ(pid.update(1.0, 0.1), 7.4);
}

TEST(Pid, TakesTheRateOfTheErrorAsGiven) {
  Pid pid(gains(2.0, 0.0, 0.5));
  EXPECT_DOUBLE_EQ(pid.update(1.0, -3.0, 0.1), 2.0 - 1.5);
}

TEST(Pid, HasNoIntegralWithoutAClamp) {
  Pid pid(gains(0.0, 10.0, 0.0));
  EXPECT_EQ(pid.update(1.0, 1.0), 0.0);
}

TEST(Pid, WindsUpUnlessItIsToldNotTo) {
  for (const bool antiwindup : {false, true}) {
    Pid pid(gains(0.0, 2.0, 0.0, 1.0, antiwindup));
    EXPECT_DOUBLE_EQ(pid.update(5.0, 1.0), 1.0);  // 10, clamped
    // The integral of 5 first falls to 0.5, or is there at once with antiwindup.
    EXPECT_DOUBLE_EQ(pid.update(-1.0, 1.0), antiwindup ? -1.0 : 1.0);
  }
}

TEST(Pid, ClampsTheIntegralOfANegativeGain) {
  Pid pid(gains(0.0, -2.0, 0.0, 1.0, true));
  EXPECT_DOUBLE_EQ(pid.update(5.0, 1.0), -1.0);
  EXPECT_DOUBLE_EQ(pid.update(-0.5, 1.0), 0.0);
}

TEST(Pid, GivesNothingForNoTimeAndForNoNumber) {
  Pid pid(gains(1.0, 1.0, 1.0, 10.0));
  EXPECT_EQ(pid.update(1.0, 0.0), 0.0);
  EXPECT_EQ(pid.update(NAN, 0.1), 0.0);
  EXPECT_EQ(pid.update(INFINITY, 0.1), 0.0);
  EXPECT_EQ(pid.update(1.0, NAN, 0.1), 0.0);
  EXPECT_DOUBLE_EQ(pid.update(1.0, 1.0), 3.0);  // as the first
}

TEST(Pid, ReadsItsGains) {
  const PidGains found = read({{"p", {"", 100}},
                               {"i", number(0.5)},
                               {"d", number(10.0)},
                               {"i_clamp", number(-3.0)},
                               {"antiwindup", {"", true}}});
  EXPECT_EQ(found.p, 100.0);
  EXPECT_EQ(found.i, 0.5);
  EXPECT_EQ(found.d, 10.0);
  EXPECT_EQ(found.i_clamp_min, -3.0);
  EXPECT_EQ(found.i_clamp_max, 3.0);
  EXPECT_TRUE(found.antiwindup);
  const PidGains sides = read({{"p", number(1.0)},
                               {"i_clamp", number(3.0)},
                               {"i_clamp_min", number(-1.0)},
                               {"i_clamp_max", number(2.0)}});
  EXPECT_EQ(sides.i_clamp_min, -1.0);
  EXPECT_EQ(sides.i_clamp_max, 2.0);
  EXPECT_FALSE(sides.antiwindup);
}

TEST(Pid, NeedsAProportionalGain) {
  EXPECT_THROW(read({{"i", number(1.0)}}), Error);
  EXPECT_THROW(read({{"p", {"/robot/pid/p", std::string("much")}}}), Error);
  EXPECT_THROW(read({{"p", number(1.0)}, {"i_clamp_min", number(1.0)}}), Error);
}

TEST(Pid, WarnsThatItsStateIsNotPublished) {
  std::string message;
  read({{"p", number(1.0)}, {"publish_state", {"/robot/pid/publish_state", true}}}, &message);
  EXPECT_EQ(message, "/robot/pid/publish_state has no effect: a PID's state is not published");
  read({{"p", number(1.0)}, {"publish_state", {"/robot/pid/publish_state", false}}});
}

TEST(Pid, IsTuned) {
  Pid pid(gains(1.0, 0.0, 0.0));
  const ParameterGroup tuning = pid.tuning("/robot/pid");
  EXPECT_EQ(tuning.name, "/robot/pid");
  tuning.parameters[0].set(7.0);
  EXPECT_DOUBLE_EQ(pid.update(2.0, 0.1), 14.0);
  EXPECT_EQ(tuning.parameters[0].get(), 7.0);
  pid.restore_gains();
  EXPECT_DOUBLE_EQ(pid.update(2.0, 0.1), 2.0);
}

}  // namespace
}  // namespace ardee::control
