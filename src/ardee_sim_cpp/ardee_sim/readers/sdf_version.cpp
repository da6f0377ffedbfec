// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/sdf_version.h"

#include <algorithm>
#include <string_view>

#include "ardee_sim/description/parameters.h"

namespace ardee {

std::optional<int> parse_sdf_version(const std::string& text) {
  const std::size_t point = std::min(text.find('.'), text.size());
  const auto major = to_double(std::string_view(text).substr(0, point));
  const auto minor =
      point == text.size() ? 0.0 : to_double(std::string_view(text).substr(point + 1));
  const auto is_part = [](const auto& part, double least) {
    return part && *part >= least && *part < 100.0;
  };
  if (!is_part(major, 1.0) || !is_part(minor, 0.0)) return std::nullopt;
  return 100 * static_cast<int>(*major) + static_cast<int>(*minor);
}

std::string sdf_version_text(int version) {
  return std::to_string(version / 100) + "." + std::to_string(version % 100);
}

}  // namespace ardee
