// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace ardee {

/// Where a model of Fuel, or a file of it, lies in a folder in which Gazebo's tools keep what they
/// downloaded. `address` is its URI without the scheme:
/// SERVER/1.0/OWNER/models/NAME[/VERSION[/files/FILE]]; without a version, or with "tip", the
/// newest one counts. Empty if the address is none of a model or no version is there.
std::vector<std::filesystem::path> places_in_fuel_cache(const std::filesystem::path& cache,
                                                        const std::string& address);

}  // namespace ardee
