// SPDX-License-Identifier: MIT
#include <iostream>
#include <string>

#include "ardee_sim/tools/support_markdown.h"

int main(int argc, char** argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word == "-h" || word == "--help") {
    std::cout << "usage: support_page [-h]\nPrints the page of what acts, what is warned about and "
                 "what is refused, in Markdown.\n";
    return 0;
  }
  if (!word.empty()) {
    std::cerr << "support_page: found '" << word << "', expected no argument (--help)\n";
    return 2;
  }
  std::cout << ardee::support_page();
  return 0;
}
