// SPDX-License-Identifier: MIT
#include "test/test_data.h"

namespace ardee {

std::string test_data(const std::string& name) {
  const std::string folder = ARDEE_TEST_DATA;
  return name.empty() ? folder : folder + "/" + name;
}

}  // namespace ardee
