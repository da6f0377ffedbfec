// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "ardee_sim/tools/support_markdown.h"

namespace ardee {
namespace {

TEST(SupportPage, IsWhatTheCodeSays) {
  std::ifstream file(ARDEE_TEST_DATA "/../../../../docs/support.md");
  std::ostringstream kept;
  kept << file.rdbuf();
  EXPECT_EQ(kept.str(), support_page())
      << "docs/support.md is old: rosrun ardee_sim_cpp support_page > docs/support.md";
}

TEST(SupportPage, HasAPluginsKeysTopicsAndServices) {
  const std::string page = plugins_in_markdown();
  for (const char* part :
       {"### `libgazebo_ros_diff_drive.so`\n\nOf a model. Publishes ",
        "Listens to `/cmd_vel` (geometry_msgs/Twist)", "| `commandTopic` | text | `cmd_vel` |",
        "| `bodyName` | text | required |", "Serves `/imu/calibrate`", "(dynamic_reconfigure)"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace ardee
