// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/start_pose.h"
#include "fixture.h"

namespace ardee {
namespace {

class StartPoseTest : public ReadersTest {
 protected:
  std::optional<StartPose> read(const std::string& yaml) {
    folder_.write("farm.start.yaml", yaml);
    return read_start_pose(folder_.path() + "/farm.world");
  }
  std::string refusal(const std::string& yaml) {
    return error_of([&] { read(yaml); });
  }
};

TEST_F(StartPoseTest, IsThatOfTheFileBesideTheWorld) {
  const auto pose = read("# a comment\nx_m: 51.5\ny_m: -2\nz_m: 0.065\nyaw_rad: 3.1415927\n");
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->x_m, 51.5);
  EXPECT_EQ(pose->y_m, -2.0);
  EXPECT_EQ(pose->z_m, 0.065);
  EXPECT_EQ(pose->yaw_rad, 3.1415927);
}

TEST_F(StartPoseTest, IsNoneWithoutAFile) {
  EXPECT_FALSE(read_start_pose(folder_.path() + "/other.world"));
}

TEST_F(StartPoseTest, BadFilesAreRefusedWithTheirLine) {
  EXPECT_HAS(refusal("x_m: 1\nz: 2\n"), "farm.start.yaml:2: found the key 'z', expected numbers");
  EXPECT_HAS(refusal("x_m: 1\ny_m: left\n"), ":2: y_m: found 'left', expected a finite number");
  EXPECT_HAS(refusal("x_m: .nan\n"), ":1: x_m: found '.nan', expected a finite number");
  EXPECT_HAS(refusal("yaw_rad: [1]\n"), ":1: yaw_rad: found '', expected a finite number");
  EXPECT_HAS(refusal("- 1\n"), ":1: found no keys, expected numbers x_m");
  EXPECT_HAS(refusal("x_m: [1\n"), "expected YAML");
}

}  // namespace
}  // namespace ardee
