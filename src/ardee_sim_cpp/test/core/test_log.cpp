// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/core/log.h"

namespace ardee {
namespace {

class LogTest : public ::testing::Test {
 protected:
  std::vector<std::string> said_;
  Log log_{[this](LogLevel level, const std::string& text) {
    said_.push_back((level == LogLevel::kError ? "error: " : "") + text);
  }};
};

TEST_F(LogTest, AGroupGivesEachKindOfWarningOnceWithItsCount) {
  {
    const LogGroup group(log_);
    for (int line = 3; line < 88; ++line) {
      log_.warn(Source{"a.world", line, "slip"}, "not known");
      if (line == 5) log_.warn(Source{"a.world", line, "skip"}, "not known");
    }
    EXPECT_TRUE(said_.empty());
  }
  EXPECT_EQ(said_, (std::vector<std::string>{"a.world:3: <slip>: not known (and 84 more)",
                                             "a.world:5: <skip>: not known"}));
}

TEST_F(LogTest, OutsideOfAGroupEachWarningIsGivenAtOnce) {
  log_.warn(Source{"a", 1, "x"}, "y");
  log_.warn(Source{"a", 2, "x"}, "y");
  EXPECT_EQ(said_, (std::vector<std::string>{"a:1: <x>: y", "a:2: <x>: y"}));
}

TEST_F(LogTest, TheOutermostGroupCountsAndEndsItsCount) {
  {
    const LogGroup outer(log_);
    for (int i = 0; i < 2; ++i) {
      const LogGroup inner(log_);
      log_.warn("plain");
    }
    EXPECT_TRUE(said_.empty());
  }
  {
    const LogGroup next(log_);
    log_.warn("plain");
  }
  EXPECT_EQ(said_, (std::vector<std::string>{"plain (and 1 more)", "plain"}));
}

TEST_F(LogTest, WarningsOfWhatFailsAreGivenToo) {
  EXPECT_THROW(
      {
        const LogGroup group(log_);
        log_.warn("first");
        throw Error("then");
      },
      Error);
  EXPECT_EQ(said_, std::vector<std::string>{"first"});
}

}  // namespace
}  // namespace ardee
