// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "../test_data.h"
#include "ardee_sim/simulation/plugins.h"
#include "ardee_sim/tools/made_plugin.h"
#include "ardee_sim/tools/support_markdown.h"

namespace ardee {
using namespace devices;
namespace {

TEST(SupportPage, IsWhatTheCodeSays) {
  std::ifstream file(test_data("../../../../docs/support.md"));
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

TEST(SupportPage, EachPluginWarnsOfAKeyThatItDoesNotRead) {
  const Registry registry = known_plugins();
  const auto check = [](const std::string& file, bool in_sensor) {
    const MadePlugin made(file, in_sensor, "<noSuchKey>1</noSuchKey>");
    int said = 0;
    for (const std::string& warning : made.warnings()) {
      said += warning.find("<noSuchKey>: unknown key, ignored") != std::string::npos;
    }
    EXPECT_EQ(said, 1) << file;
  };
  for (const std::string& file : registry.model_plugin_files()) check(file, false);
  for (const std::string& file : registry.sensor_plugin_files()) check(file, true);
}

}  // namespace
}  // namespace ardee
