// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ardee {

/// Path of a model of Fuel, or of a file of it, in a download folder of Gazebo's tools. `address`
/// is its URI without the scheme: SERVER/1.0/OWNER/models/NAME[/VERSION[/files/FILE]]; without a
/// version, or with "tip", the newest one counts. Empty if the address is not that of a model or no
/// version exists.
std::vector<std::filesystem::path> places_in_fuel_cache(const std::filesystem::path& cache,
                                                        const std::string& address);

}  // namespace ardee
