// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "ardee_sim/core/normal_table.h"

namespace ardee {
namespace {

TEST(NormalTable, HasTheQuantilesOfTheStandardNormalDistribution) {
  double sum = 0.0, squares = 0.0, fourths = 0.0;
  int below[3] = {0, 0, 0};
  constexpr double kLimits[] = {-1.0, 0.5, 2.0};
  for (int bits = 0; bits < 65536; ++bits) {
    const double z = NormalTable::get()[static_cast<std::uint16_t>(bits)];
    sum += z;
    squares += z * z;
    fourths += z * z * z * z;
    for (int k = 0; k < 3; ++k) below[k] += z < kLimits[k] ? 1 : 0;
  }
  EXPECT_NEAR(sum / 65536, 0.0, 1e-6);
  EXPECT_NEAR(squares / 65536, 1.0, 1e-5);
  EXPECT_NEAR(fourths / 65536, 3.0, 0.01);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(below[k] / 65536.0, 0.5 * std::erfc(-kLimits[k] / std::sqrt(2.0)), 1e-4);
  }
}

TEST(NormalTable, LooksUpManyAsItDoesOne) {
  constexpr std::size_t kAll = 65536;
  std::vector<std::uint16_t> bits(kAll);
  std::iota(bits.begin(), bits.end(), std::uint16_t{0});
  std::vector<float> many(kAll);
  NormalTable::get().look_up<kAll>(bits.data(), many.data());
  for (std::size_t k = 0; k < kAll; ++k) {
    EXPECT_EQ(many[k], NormalTable::get()[bits[k]]);
    EXPECT_EQ(many[k], -many[kAll / 2 ^ k]);  // the uppermost bit is the sign
    EXPECT_EQ(many[k] > 0.0f, k >= kAll / 2);
  }
}

}  // namespace
}  // namespace ardee
