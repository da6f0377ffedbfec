// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/urdf.h"

namespace ardee {
namespace {

std::vector<std::string> read_interfaces(const Node& joint) {
  std::vector<std::string> interfaces;
  joint.each("hardwareInterface", [&interfaces](const Node& interface) {
    interfaces.push_back(interface.required_text());
  });
  if (interfaces.empty()) {
    throw joint.error("found no <hardwareInterface>, expected one");
  }
  return interfaces;
}

Transmission read(const Node& node, std::size_t& joints) {
  Transmission made;
  made.source = node.source();
  made.name = node.required_attribute("name");
  node.required("type").required_text();
  node.required("joint");
  node.each("joint", [&](const Node& joint) {
    ++joints;
    made.joint = joint.required_attribute("name");
    made.interfaces = read_interfaces(joint);
  });
  node.required("actuator");
  node.each("actuator", [](const Node& actuator) { actuator.required_attribute("name"); });
  return made;
}

}  // namespace

std::optional<Transmission> read_transmission(const Node& node, Log& log) {
  const std::string left_out = "transmission '" + node.attribute("name") + "' is left out";
  try {
    std::size_t joints = 0;
    Transmission made = read(node, joints);
    if (joints == 1) return made;
    log.warn(node.source(), "found several joints, expected one", "; " + left_out);
  } catch (const Error& error) {
    log.error(std::string(error.what()) + "; " + left_out);
  }
  return std::nullopt;
}

}  // namespace ardee
