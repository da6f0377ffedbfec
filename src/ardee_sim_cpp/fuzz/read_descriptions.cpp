// SPDX-License-Identifier: MIT
#include "fuzz/inputs.h"
#include "fuzz/targets.h"

namespace ardee::fuzz {

void read_world(const std::string& input) { make_loader().load_world_text(input, "fuzz.world"); }

void read_model(const std::string& input) { make_loader().load_model_text(input, "fuzz.xml"); }

}  // namespace ardee::fuzz
