// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/core/nearest_names.h"

namespace ardee {
namespace {

TEST(EditDistance, CountsInsertedRemovedAndReplacedLetters) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("farm", "farm"), 0u);
  EXPECT_EQ(edit_distance("fram", "farm"), 2u);
}

TEST(NearestNames, TheNearestComeFirst) {
  EXPECT_EQ(nearest_names("fram.world", {"corn.world", "empty.world", "farm.world"}),
            "farm.world, corn.world, empty.world");
  EXPECT_EQ(nearest_names("LASER", {"bumper", "laser"}), "laser, bumper");
}

TEST(NearestNames, ANameThatTheWrongOneBeginsComesBeforeOneOfTheSameLength) {
  EXPECT_EQ(nearest_names("corn", {"horn", "corn_variant_1"}), "corn_variant_1, horn");
}

TEST(NearestNames, OfManyOnlyFiveAreListed) {
  EXPECT_EQ(nearest_names("g", {"a", "b", "c", "d", "e", "f", "g1"}),
            "g1, a, b, c, d, ... (7 in all)");
  EXPECT_EQ(nearest_names("x", {"a", "b", "c", "d", "e"}), "a, b, c, d, e");
}

TEST(NearestNames, WithoutAnyItSaysNone) { EXPECT_EQ(nearest_names("x", {}), "none"); }

}  // namespace
}  // namespace ardee
