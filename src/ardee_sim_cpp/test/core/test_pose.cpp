// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "ardee_sim/core/pose.h"

namespace ardee {
namespace {

TEST(Pose, RollPitchYawTurnAboutFixedAxes) {
  // A quarter turn of yaw takes x to y; roll before it leaves x alone.
  const Pose pose = Pose::from_xyz_rpy({1, 2, 3}, {M_PI / 2, 0, M_PI / 2});
  EXPECT_TRUE((pose * Eigen::Vector3d(1, 0, 0)).isApprox(Eigen::Vector3d(1, 3, 3)));
  // y is rolled up to z, which yaw leaves.
  EXPECT_TRUE((pose * Eigen::Vector3d(0, 1, 0)).isApprox(Eigen::Vector3d(1, 2, 4)));
}

TEST(Pose, InverseUndoes) {
  const Pose pose = Pose::from_xyz_rpy({1, -2, 0.5}, {0.3, -0.7, 2.1});
  const Pose identity = pose * pose.inverse();
  EXPECT_NEAR(identity.p.norm(), 0.0, 1e-14);
  EXPECT_NEAR(identity.q.angularDistance(Eigen::Quaterniond::Identity()), 0.0, 1e-7);
}

TEST(Pose, AnglesComeBack) {
  for (const Eigen::Vector3d& rpy :
       {Eigen::Vector3d(0.1, 0.2, 0.3), Eigen::Vector3d(-3.0, 1.5, -2.0),
        Eigen::Vector3d(0, 0, M_PI)}) {
    EXPECT_TRUE(rpy_from_quaternion(quaternion_from_rpy(rpy)).isApprox(rpy, 1e-9));
  }
}

TEST(Pose, AtPitchNinetyTheRotationComesBackThoughItsAnglesNeedNot) {
  const Eigen::Quaterniond q = quaternion_from_rpy({0.4, M_PI / 2, 0.9});
  EXPECT_LT(quaternion_from_rpy(rpy_from_quaternion(q)).angularDistance(q), 1e-6);
}

}  // namespace
}  // namespace ardee
