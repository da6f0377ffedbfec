// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace ardee {

/// Returns the path of a file of the tests' data; of their folder if no name is given.
std::string test_data(const std::string& name = "");

}  // namespace ardee
