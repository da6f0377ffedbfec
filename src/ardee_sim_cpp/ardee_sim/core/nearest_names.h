// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace ardee {

/// Returns the least number of letters to insert, remove or replace that turns `from` into `to`
/// (Levenshtein's distance).
std::size_t edit_distance(const std::string& from, const std::string& to);

/// Returns for a message the known names that are nearest to a wrong one, the nearest first:
/// "a, b", of more than five "a, b, c, d, e, ... (24 in all)", and "none" if there are none.
std::string nearest_names(const std::string& name, const std::vector<std::string>& known);

}  // namespace ardee
