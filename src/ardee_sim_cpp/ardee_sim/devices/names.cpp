// SPDX-License-Identifier: MIT
#include "ardee_sim/devices/names.h"

namespace ardee::devices {

std::string without_slashes(const std::string& text) {
  const std::size_t first = text.find_first_not_of('/');
  if (first == std::string::npos) return "";
  const std::size_t last = text.find_last_not_of('/');
  return text.substr(first, last - first + 1);
}

std::string plugin_namespace(Parameters& parameters, const DeviceContext& context) {
  const std::string own = parameters.text("robotNamespace", "");
  return without_slashes(own.empty() ? context.robot_namespace : own);
}

std::string resolve_topic(const std::string& topic, const std::string& robot_namespace) {
  if (without_slashes(topic).empty()) {
    throw Error("found '" + topic + "' as a topic or service, expected a name");
  }
  if (topic.front() == '/') return topic;
  const std::string space = without_slashes(robot_namespace);
  return (space.empty() ? "/" : "/" + space + "/") + topic;
}

std::string resolve_frame(const std::string& frame, const std::string& robot_namespace,
                          const DeviceContext& context, WithoutPrefix without_prefix) {
  std::string prefix =
      context.frame_prefix ? without_slashes(context.frame_prefix(robot_namespace)) : std::string();
  if (prefix.empty() && without_prefix == WithoutPrefix::kNamespace) {
    prefix = without_slashes(robot_namespace);
  }
  // An absolute frame is used unchanged, as in tf::resolve.
  if (prefix.empty() || (!frame.empty() && frame.front() == '/')) return without_slashes(frame);
  return prefix + "/" + without_slashes(frame);
}

std::string plugin_frame(Parameters& parameters, const char* key, const char* fallback,
                         const std::string& robot_namespace, const DeviceContext& context,
                         WithoutPrefix without_prefix) {
  return resolve_frame(without_slashes(parameters.text(key, fallback)), robot_namespace, context,
                       without_prefix);
}

std::size_t plugin_link(Parameters& parameters, const DeviceContext& context) {
  const Element* body = parameters.block("bodyName");
  if (!body || body->text.empty()) return 0;
  return context.link_index(body->text, body->source);
}

}  // namespace ardee::devices
