// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ardee_sim/description/setting.h"

namespace ardee::devices {

/// A plugin file of another name whose work a plugin of the registry does.
struct PluginAlias {
  std::string filename;
  std::string plugin;                       // of the registry
  std::map<std::string, std::string> keys;  // from the other plugin's key to ours
};

/// Reads a list of maps of filename, plugin and, where they differ, keys. Throws Error.
std::vector<PluginAlias> read_plugin_aliases(const Setting& list);

/// Reads the list `plugin_aliases` of a YAML file's text. Throws Error with file and line.
std::vector<PluginAlias> read_plugin_aliases(const std::string& yaml, const std::string& file);

/// Names under which plugins of builtin_registry are published elsewhere:
/// config/plugin_aliases.yaml.
const std::vector<PluginAlias>& builtin_aliases();

}  // namespace ardee::devices
