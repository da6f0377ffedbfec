// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/pose.h"

namespace ardee {

/// The first line of a table of instances. Positions are in metres in the frame of the parent
/// model, angles in radians; label 0: none.
constexpr std::string_view kInstanceColumns =
    "model,name,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,scale,label";

/// One line of the table; its texts refer to the line and are valid as long as it.
struct InstanceRow {
  int line = 0;
  std::string_view model;  // URI
  std::string_view name;
  Pose pose;
  double scale = 1.0;
  std::uint32_t label = 0;
};

/// Reads a table of instances line by line, holding no more than a line, and calls visit(row) for
/// each. Throws Error with file and line for the first invalid row, such as a row without a line
/// end (a truncated file), and at `source` if there is no file to read.
void read_instance_table(const std::string& path, const Source& source,
                         const std::function<void(const InstanceRow&)>& visit);

}  // namespace ardee
