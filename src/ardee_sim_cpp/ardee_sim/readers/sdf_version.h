// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace ardee {

/// Versions of SDF as numbers that compare: 1.7 is 107, 1.10 is 110. Files of an older or newer
/// version than these are read as the nearest; kNewestClassicSdf is Gazebo Classic's.
constexpr int kOldestSdf = 102;
constexpr int kNewestSdf = 112;
constexpr int kNewestClassicSdf = 107;

/// Parses a version; none if the text is not one.
std::optional<int> parse_sdf_version(const std::string& text);
std::string sdf_version_text(int version);

}  // namespace ardee
