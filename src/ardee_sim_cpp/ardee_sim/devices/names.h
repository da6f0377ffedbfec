// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// The namespace of a plugin: its <robotNamespace>, or if that is absent or empty, the namespace in
/// which the robot was spawned.
std::string plugin_namespace(Parameters& parameters, const DeviceContext& context);

/// Removes the slashes at the ends of a text.
std::string without_slashes(const std::string& text);

/// Resolves a topic as a ROS node in `robot_namespace` does: an absolute name stays, a relative one
/// goes below the namespace. Throws Error if the name is empty.
std::string resolve_topic(const std::string& topic, const std::string& robot_namespace);

/// Prefix of a frame whose namespace has no prefix of its own (DeviceContext::frame_prefix). The
/// stock diff drive, lasers and cameras use the namespace, the other stock plugins nothing.
enum class WithoutPrefix { kNothing, kNamespace };

/// Resolves a frame for tf2: no leading slash, the prefix of the namespace in front (as tf::resolve
/// does).
std::string resolve_frame(const std::string& frame, const std::string& robot_namespace,
                          const DeviceContext& context,
                          WithoutPrefix without_prefix = WithoutPrefix::kNothing);

/// The frame that a drive's key names, below the prefix of the namespace even with a leading slash,
/// as in the stock plugins: an absolute "/odom" would be lost in tf2.
std::string plugin_frame(Parameters& parameters, const char* key, const char* fallback,
                         const std::string& robot_namespace, const DeviceContext& context,
                         WithoutPrefix without_prefix = WithoutPrefix::kNothing);

/// The link of its own robot that a model plugin's <bodyName> names; the first link if there is no
/// such key. Throws Error if the robot has no such link.
std::size_t plugin_link(Parameters& parameters, const DeviceContext& context);

}  // namespace ardee::devices
