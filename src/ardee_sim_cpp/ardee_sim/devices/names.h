// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/devices/device.h"

namespace ardee::devices {

/// The namespace of a plugin: its <robotNamespace>, or where that is absent or empty the one the
/// robot was spawned in.
std::string plugin_namespace(Parameters& parameters, const DeviceContext& context);

/// Without those at its ends.
std::string without_slashes(const std::string& text);

/// A topic as a ROS node in `robot_namespace` would resolve it: absolute stays, relative goes below
/// the namespace. Throws Error if there is no name.
std::string resolve_topic(const std::string& topic, const std::string& robot_namespace);

/// What stands before a frame where its namespace has no tf_prefix. Of the stock plugins the diff
/// drive, lasers and cameras put the namespace there, the others nothing.
enum class WithoutPrefix { kNothing, kNamespace };

/// A frame as tf2 wants it: no leading slash, the namespace's tf_prefix in front (as tf::resolve
/// does).
std::string resolve_frame(const std::string& frame, const std::string& robot_namespace,
                          const DeviceContext& context,
                          WithoutPrefix without_prefix = WithoutPrefix::kNothing);

/// The frame that a drive's key names, below the namespace's tf_prefix with a leading slash too, as
/// the stock plugins have it: an absolute "/odom" would be lost in tf2.
std::string plugin_frame(Parameters& parameters, const char* key, const char* fallback,
                         const std::string& robot_namespace, const DeviceContext& context,
                         WithoutPrefix without_prefix = WithoutPrefix::kNothing);

/// The link that a model plugin's <bodyName> names, of its own robot; the first where there is
/// none. Throws Error if the robot has no such link.
std::size_t plugin_link(Parameters& parameters, const DeviceContext& context);

}  // namespace ardee::devices
