// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "ardee_sim/description/scenery.h"

namespace ardee {
namespace {

std::shared_ptr<Model> model_with_link() {
  auto model = std::make_shared<Model>();
  model->links.emplace_back();
  return model;
}

TEST(Scenery, NestedPosesScalesAndLabelsMultiplyDown) {
  const auto plant = model_with_link();
  auto plot = std::make_shared<Model>();
  plot->instances.push_back({plant, "a", Pose::from_xyz_rpy({1, 0, 0}, {0, 0, 0}), 1.5, 0, true});
  plot->instances.push_back(
      {plant, "b", Pose::from_xyz_rpy({0, 2, 0}, {0, 0, M_PI / 2}), 1.0, 9, true});
  const Instance field{plot, "field", Pose::from_xyz_rpy({10, 0, 0}, {0, 0, -M_PI / 2}),
                       2.0,  4,       true};

  const auto placements = flatten_scenery(field);
  ASSERT_EQ(placements.size(), 2u);  // the plot itself has no links
  // A rotation by -90 degrees takes (2 * 1, 0) to (0, -2).
  EXPECT_TRUE(placements[0].X_WM.p.isApprox(Eigen::Vector3d(10, -2, 0)));
  EXPECT_EQ(placements[0].scale, 3.0);
  EXPECT_EQ(placements[0].label, 4u);
  EXPECT_TRUE(placements[1].X_WM.p.isApprox(Eigen::Vector3d(14, 0, 0)));
  EXPECT_NEAR(placements[1].X_WM.q.angularDistance(Eigen::Quaterniond::Identity()), 0.0, 1e-7);
  EXPECT_EQ(placements[1].label, 9u);
}

TEST(Scenery, PlacementsShareTheDescription) {
  const auto plant = model_with_link();
  auto field = std::make_shared<Model>();
  for (int i = 0; i < 1000; ++i) field->instances.push_back({plant, "p", Pose{}, 1.0, 0, true});
  const auto placements = flatten_scenery({field, "field", Pose{}, 1.0, 0, true});
  ASSERT_EQ(placements.size(), 1000u);
  EXPECT_EQ(placements.front().model.get(), placements.back().model.get());
}

}  // namespace
}  // namespace ardee
