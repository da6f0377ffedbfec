// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "ardee_sim/core/error.h"
#include "ardee_sim/devices/plugin_aliases.h"

namespace ardee {
using namespace devices;
namespace {

TEST(PluginAliasFile, GivesItsRows) {
  const auto aliases = read_plugin_aliases(
      "plugin_aliases:  # of a laboratory\n"
      "  - filename: liba.so\n"
      "    plugin: libb.so\n"
      "  - {filename: c, plugin: d, keys: {lat0: referenceLatitude, '2': topicName}}\n",
      "lab.yaml");
  ASSERT_EQ(aliases.size(), 2u);
  EXPECT_EQ(aliases[0].filename, "liba.so");
  EXPECT_EQ(aliases[0].plugin, "libb.so");
  EXPECT_TRUE(aliases[0].keys.empty());
  EXPECT_EQ(aliases[1].filename, "c");
  EXPECT_EQ(aliases[1].plugin, "d");
  const std::map<std::string, std::string> keys{{"lat0", "referenceLatitude"}, {"2", "topicName"}};
  EXPECT_EQ(aliases[1].keys, keys);
}

std::string refusal(const std::string& yaml) {
  try {
    read_plugin_aliases(yaml, "lab.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PluginAliasFile, IsRefusedByLine) {
  EXPECT_EQ(refusal(""),
            "lab.yaml: /plugin_aliases: found nothing, expected a list of plugin aliases");
  EXPECT_EQ(refusal("plugin_aliases:\n  filename: a\n"),
            "lab.yaml:2: /plugin_aliases: found a group of 1, expected a list of plugin aliases");
  EXPECT_EQ(refusal("plugin_aliases:\n- a\n"),
            "lab.yaml:2: /plugin_aliases[0]: found 'a', expected a map of filename, plugin and "
            "keys");
  EXPECT_EQ(refusal("plugin_aliases:\n- filename: a\n"),
            "lab.yaml:2: /plugin_aliases[0]/plugin: found nothing, expected a text");
  EXPECT_EQ(refusal("plugin_aliases:\n- filename: a\n  plugin: b\n  key: {c: d}\n"),
            "lab.yaml:4: /plugin_aliases[0]/key: found 'key', expected a map of filename, plugin "
            "and keys");
  EXPECT_EQ(refusal("plugin_aliases:\n- filename: a\n  plugin: b\n  keys: {c: [d]}\n"),
            "lab.yaml:4: /plugin_aliases[0]/keys/c: found a list of 1, expected a text");
  EXPECT_EQ(refusal("plugin_aliases:\n- filename: a\n  plugin: b\n  plugin: c\n"),
            "lab.yaml:2: /plugin_aliases[0]: found 'plugin' twice, expected it once");
  EXPECT_EQ(refusal("plugin_aliases:\n- {filename: a\n").rfind("lab.yaml:3: found ", 0), 0u);
}

TEST(PluginAliasFile, OfAParameterHasWordsOnly) {
  const Setting list(
      "/aliases",
      Setting::List{{"/aliases[0]", Setting::Map{{"filename", {"/aliases[0]/filename", 5}},
                                                 {"plugin", {"/aliases[0]/plugin", "b"}}}}});
  try {
    read_plugin_aliases(list);
    FAIL() << "a number is no name";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "/aliases[0]/filename: found the integer 5, expected a text");
  }
}

}  // namespace
}  // namespace ardee
