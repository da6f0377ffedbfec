// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/gps_regions.h"
#include "ardee_sim/readers/xml.h"
#include "fuzz/inputs.h"
#include "fuzz/targets.h"

namespace ardee::fuzz {
namespace {

void make_regions(const Element& plugin) {
  Log log = quiet_log();
  const devices::GpsRegions regions(plugin, {}, ResourceLocator::from_environment(), log);
  for (const devices::GpsRegion& region : regions.all()) {
    regions.find(region.pose.p);
    if (region.periodic) region.periodic->at(0, CounterRng(1));
  }
}

Element key(const std::string& name, const std::string& text) {
  return {name, text, {}, {}, {"fuzz.world", 1, name}};
}

}  // namespace

void read_gps(const std::string& input) {
  const XmlFile document(input, "fuzz.xml");
  Element root = document.root().to_element();
  if (root.name == "plugin") return make_regions(root);
  const std::string path = write_input("plots.xacro", input);
  const std::string bands = ARDEE_PACKAGES "/ardee_geofence/default_gps_behavior.geofence";
  Element plugin = key("plugin", "");
  try {
    plugin.children = {key("geofenceFile", path)};
    make_regions(plugin);
  } catch (const Error&) {
    plugin.children = {key("geofenceFile", bands), key("plotsFile", path)};
    make_regions(plugin);
  }
}

}  // namespace ardee::fuzz
