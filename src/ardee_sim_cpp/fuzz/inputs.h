// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ardee_sim/readers/loader.h"

namespace ardee::fuzz {

/// Returns a log that drops its messages.
Log quiet_log();

/// Returns a loader that finds the test data as model://, file:// and package://test_data, the sun
/// and the ground plane of ardee_models, and the packages beside this one.
Loader make_loader();

/// Writes the input as a file of that name and returns its path. The next input replaces the file;
/// the folder is removed at the program's end.
std::string write_input(const std::string& name, const std::string& input);

}  // namespace ardee::fuzz
