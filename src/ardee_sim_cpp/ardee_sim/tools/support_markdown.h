// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace ardee {

/// docs/support.md: the inputs that act, give a warning or are refused, made from the tables of
/// elements, from the plugins of the registry, each made once, and from the node's own lists.
std::string support_page();

/// Its parts, in Markdown.
std::string elements_in_markdown();
std::string plugins_in_markdown();
std::string node_in_markdown();

}  // namespace ardee
