// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/element.h"
#include "ardee_sim/render/image_formation.h"

namespace ardee::devices {

/// The format that SDF's <format> names, as SDF, Gazebo or ROS spells it. A format with more
/// channels or bits than a picture has here gives a warning and becomes red, green and blue of
/// eight bits. Throws Error for an unknown format.
render::PixelFormat read_pixel_format(const std::string& name, const Source& source, Log& log);

/// The format of an encoding of sensor_msgs/image_encodings. Throws Error for an unknown encoding.
render::PixelFormat read_encoding(const std::string& name, const Source& source);

/// Name of a format in sensor_msgs/image_encodings.
const char* encoding_of(render::PixelFormat format);

}  // namespace ardee::devices
