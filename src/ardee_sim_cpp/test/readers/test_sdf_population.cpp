// SPDX-License-Identifier: MIT
#include <cmath>

#include "fixture.h"

namespace ardee {
namespace {

class SdfPopulation : public ReadersTest {
 protected:
  World populate(const std::string& rest, const std::string& pose = "0 0 0 0 0 0") {
    return world(
        "<population name='field'><model name='stalk'><static>true</static><link name='l'/>"
        "</model><pose>" +
        pose + "</pose>" + rest + "</population>");
  }
  static std::string how(const std::string& type, const std::string& more = "") {
    return "<distribution><type>" + type + "</type>" + more + "</distribution>";
  }
};

constexpr const char* kBox = "<box><size>4 2 0.5</size></box>";
constexpr const char* kThree = "<model_count>3</model_count>";

TEST_F(SdfPopulation, StandsInAGridAboutItsPose) {
  const World w = populate(kBox + how("grid", "<rows>2</rows><cols>3</cols><step>0.5 2 0</step>"),
                           "10 20 1 0 0 1.5707963267948966");
  ASSERT_EQ(w.models.size(), 6u);
  EXPECT_EQ(w.models[0].name, "stalk_clone_0");
  EXPECT_EQ(w.models[5].name, "stalk_clone_5");
  EXPECT_EQ(w.models[5].model, w.models[0].model);
  EXPECT_TRUE(w.models[0].is_static);
  // Columns run along the population's x, the world's y; rows along its y, the world's -x.
  expect_near(w.models[0].pose.p, Eigen::Vector3d(11, 19.5, 1));
  expect_near(w.models[2].pose.p, Eigen::Vector3d(11, 20.5, 1));
  expect_near(w.models[5].pose.p, Eigen::Vector3d(9, 20.5, 1));
  EXPECT_NEAR(w.models[0].pose.q.z(), std::sqrt(0.5), 1e-12);
  EXPECT_TRUE(warnings_->empty());
}

TEST_F(SdfPopulation, StandsInALineFromEndToEnd) {
  const World along_x = populate(kBox + (kThree + how("linear-x")));
  expect_near(along_x.models.at(0).pose.p, Eigen::Vector3d(-2, 0, 0));
  expect_near(along_x.models.at(1).pose.p, Eigen::Vector3d(0, 0, 0));
  expect_near(along_x.models.at(2).pose.p, Eigen::Vector3d(2, 0, 0));
  const World along_z = populate(kBox + (kThree + how("linear-z")));
  expect_near(along_z.models.at(2).pose.p, Eigen::Vector3d(0, 0, 0.25));
}

TEST_F(SdfPopulation, RandomPlacesFillTheirRegionEvenly) {
  constexpr int kCount = 10'000;
  const std::string count = "<model_count>" + std::to_string(kCount) + "</model_count>";
  for (const std::string type : {"random", "uniform"}) {
    const World in_box = populate(kBox + count + how(type));
    ASSERT_EQ(in_box.models.size(), std::size_t{kCount});
    Eigen::Vector3d sum(0, 0, 0);
    for (const Instance& each : in_box.models) {
      EXPECT_TRUE((each.pose.p.cwiseAbs().array() <= Eigen::Array3d(2, 1, 0.25)).all());
      sum += each.pose.p;
    }
    // The bound is four standard errors of a uniform distribution's mean.
    const Eigen::Array3d most = 4.0 * Eigen::Array3d(4, 2, 0.5) / std::sqrt(12.0 * kCount);
    EXPECT_TRUE(((sum / kCount).array().abs() <= most).all()) << type;
    const World in_cylinder =
        populate("<cylinder><radius>2</radius><length>1</length></cylinder>" + count + how(type));
    int inner = 0;
    for (const Instance& each : in_cylinder.models) {
      EXPECT_LE(each.pose.p.head<2>().norm(), 2.0 + 1e-12);
      inner += each.pose.p.head<2>().norm() < 1.0 ? 1 : 0;
    }
    // The inner part is a quarter of the area; the bound is four standard deviations of a binomial.
    EXPECT_NEAR(inner, kCount / 4, 4.0 * std::sqrt(kCount * 0.25 * 0.75)) << type;
    const World again = populate(kBox + count + how(type));
    EXPECT_EQ(again.models.back().pose.p, in_box.models.back().pose.p) << type;
  }
}

/// Returns the least distance between any two models.
double least_distance(const World& w) {
  double least = 1e9;
  for (std::size_t i = 0; i < w.models.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      least = std::min(least, (w.models[i].pose.p - w.models[k].pose.p).norm());
    }
  }
  return least;
}

TEST_F(SdfPopulation, UniformKeepsThemApart) {
  const std::string flat = "<box><size>10 10 0</size></box><model_count>200</model_count>";
  EXPECT_GT(least_distance(populate(flat + how("uniform"))),
            4.0 * least_distance(populate(flat + how("random"))));
}

TEST_F(SdfPopulation, WhatCannotBeIsSaidWithItsPlace) {
  const auto error = [this](const std::string& rest) { return error_of([&] { populate(rest); }); };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(error(kBox + how("spiral")), "found 'spiral', expected random"));
  EXPECT_TRUE(has(error(how("random")), "found no <box> and no <cylinder>"));
  EXPECT_TRUE(has(error(kBox), "<distribution>"));
  EXPECT_TRUE(has(error(kBox + how("grid", "<rows>2000</rows><cols>2000</cols>")), "<cols>"));
  EXPECT_TRUE(has(error(kBox + ("<model_count>0</model_count>" + how("random"))), "model_count"));
  EXPECT_TRUE(has(error("<box><size>-1 1 1</size></box>" + how("random")), "below 0 m"));
  const std::string many = std::string(kBox) + "<model_count>600000</model_count>" + how("random");
  EXPECT_TRUE(has(error(many +
                        "</population><population name='more'><model name='stalk'>"
                        "<link name='l'/></model>" +
                        many),
                  "<population>"));
  populate(std::string(kBox) + "<modelcount>3</modelcount>" + how("random"));
  EXPECT_TRUE(warned("<modelcount>"));
}

}  // namespace
}  // namespace ardee
