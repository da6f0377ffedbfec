// SPDX-License-Identifier: MIT
#include <iostream>

#include "ardee_sim/tools/support_markdown.h"

int main() {
  std::cout << ardee::support_page();
  return 0;
}
