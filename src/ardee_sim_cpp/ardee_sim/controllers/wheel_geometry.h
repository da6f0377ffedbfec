// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ardee_sim/description/model.h"
#include "ardee_sim/description/setting.h"

namespace ardee::control {

/// The joints that a parameter names: one text or a list of them. Throws Error if none is named.
std::vector<std::string> joint_names(const Setting& settings, const std::string& key);

/// The origin of a joint in the model's frame. If the description has no such joint, throws an
/// Error that the parameter `source` is missing.
Eigen::Vector3d joint_origin(const Model& model, const std::string& joint, const Setting& source);

enum class WheelShape { kCylinder, kCylinderOrSphere };

/// The parameter wheel_radius, or else the radius of the first collision of the link that a joint
/// turns. Throws Error as joint_origin() does if the collision has another shape.
double wheel_radius(const Setting& settings, const Model& model, const std::string& joint,
                    WheelShape shape);

/// Reads a number above 0. Throws Error otherwise.
double positive(double number, const Setting& source);

/// Reads a multiplier, 1 by default. Throws Error if it is 0.
double read_multiplier(const Setting& settings, const std::string& key);

}  // namespace ardee::control
