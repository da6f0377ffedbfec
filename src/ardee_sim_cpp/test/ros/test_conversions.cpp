// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ardee_sim/core/error.h"
#include "ros/conversions.h"

namespace ardee::node {
namespace {

geometry_msgs::Pose pose_message(double x, double y, double z, double w) {
  geometry_msgs::Pose message;
  message.position.x = 1.0;
  message.orientation.x = x;
  message.orientation.y = y;
  message.orientation.z = z;
  message.orientation.w = w;
  return message;
}

TEST(Conversions, AQuaternionOfZerosIsNoRotation) {
  const Pose pose = from_ros(pose_message(0, 0, 0, 0));
  EXPECT_EQ(pose.q.w(), 1.0);
  EXPECT_EQ(pose.p.x(), 1.0);
}

TEST(Conversions, AQuaternionOfAnyLengthIsARotation) {
  for (const double length : {1e-6, 2.0, 1e200}) {
    const Pose pose = from_ros(pose_message(0, 0, length, length));
    EXPECT_NEAR(pose.q.z(), std::sqrt(0.5), 1e-12) << length;
    EXPECT_NEAR(pose.q.norm(), 1.0, 1e-12) << length;
  }
}

TEST(Conversions, AQuaternionComesBackAsItWent) {
  const Pose pose = Pose::from_xyz_rpy({1, -2, 3}, {0.3, -0.4, 2.5});
  const Pose back = from_ros(to_ros(pose));
  EXPECT_EQ(back.p, pose.p);
  EXPECT_NEAR(back.q.angularDistance(pose.q), 0.0, 1e-12);
}

TEST(Conversions, WhatIsNotFiniteIsRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(from_ros(pose_message(0, 0, kNan, 1)), Error);
  geometry_msgs::Pose far = pose_message(0, 0, 0, 1);
  far.position.z = std::numeric_limits<double>::infinity();
  EXPECT_THROW(from_ros(far), Error);
  geometry_msgs::Twist twist;
  EXPECT_TRUE(is_finite(from_ros(twist)));
  twist.angular.y = kNan;
  EXPECT_FALSE(is_finite(from_ros(twist)));
}

TEST(Conversions, TimesKeepTheirNanoseconds) {
  const ros::Time time = to_ros(TimeNs{12345678901});
  EXPECT_EQ(time.sec, 12u);
  EXPECT_EQ(time.nsec, 345678901u);
}

}  // namespace
}  // namespace ardee::node
