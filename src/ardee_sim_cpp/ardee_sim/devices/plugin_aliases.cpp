// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/plugin_aliases.h"

#include <yaml-cpp/yaml.h>

#include "ardee_sim/core/error.h"

namespace ardee::devices {
/// The text of config/plugin_aliases.yaml, which CMake puts into the library.
extern const char* const kPluginAliasesYaml;

namespace {

PluginAlias read_alias(const Setting& given) {
  const std::string expected = "a map of filename, plugin and keys";
  for (const auto& [name, value] : given.group(expected)) {
    if (name != "filename" && name != "plugin" && name != "keys") {
      throw Error(value.path() + ": found '" + name + "', expected " + expected);
    }
  }
  PluginAlias alias{given.text("filename"), given.text("plugin"), {}};
  const Setting keys = given.at("keys");
  if (!keys) return alias;
  for (const auto& key : keys.group("a map of names of keys")) {
    alias.keys[key.first] = keys.text(key.first);
  }
  return alias;
}

/// Converts a node of YAML with its scalars as texts. Its path is its file and line and the keys
/// above it.
Setting to_setting(const YAML::Node& node, const std::string& file, const std::string& keys) {
  const std::string path = Source{file, node.Mark().line + 1, ""}.to_string() + ": " + keys;
  if (node.IsSequence()) {
    Setting::List list;
    for (const YAML::Node& each : node) {
      list.push_back(to_setting(each, file, keys + "[" + std::to_string(list.size()) + "]"));
    }
    return {path, list};
  }
  if (node.IsMap()) {
    Setting::Map map;
    for (const auto& each : node) {
      const auto name = each.first.as<std::string>();
      if (!map.emplace(name, to_setting(each.second, file, keys + "/" + name)).second) {
        throw Error(path + ": found '" + name + "' twice, expected it once");
      }
    }
    return {path, map};
  }
  if (node.IsScalar()) return {path, node.Scalar()};
  return {path, {}};
}

}  // namespace

std::vector<PluginAlias> read_plugin_aliases(const Setting& list) {
  std::vector<PluginAlias> aliases;
  for (const Setting& each : list.list("a list of plugin aliases")) {
    aliases.push_back(read_alias(each));
  }
  return aliases;
}

std::vector<PluginAlias> read_plugin_aliases(const std::string& yaml, const std::string& file) {
  try {
    return read_plugin_aliases(to_setting(YAML::Load(yaml), file, "").at("plugin_aliases"));
  } catch (const YAML::Exception& problem) {
    throw Error(Source{file, problem.mark.line + 1, ""},
                "found " + problem.msg + ", expected YAML");
  }
}

const std::vector<PluginAlias>& builtin_aliases() {
  static const std::vector<PluginAlias> aliases =
      read_plugin_aliases(kPluginAliasesYaml, "plugin_aliases.yaml");
  return aliases;
}

}  // namespace ardee::devices
