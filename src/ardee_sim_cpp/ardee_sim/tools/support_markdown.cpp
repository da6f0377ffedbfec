// SPDX-License-Identifier: MIT
#include "ardee_sim/tools/support_markdown.h"

#include <sstream>

#include "ardee_sim/tools/node_interface.h"

namespace ardee {

std::string node_in_markdown() {
  std::ostringstream page;
  page
      << "## Services\n\nOf the node `simulator`, whose name is `gazebo`. A request that cannot be "
         "met is answered with `success: false` and the\nreason, and has changed nothing.\n\n"
         "| service | type | |\n|---|---|---|\n";
  for (const NodeService& service : node_services()) {
    page << "| `" << service.name << "` | " << service.type << " | " << service.note << " |\n";
  }
  page << "\n## Topics\n\nThose of plugins are with the plugins.\n\n"
          "| topic | type | | |\n|---|---|---|---|\n";
  for (const NodeTopic& topic : node_topics()) {
    page << "| `" << topic.name << "` | " << topic.type << " | "
         << (topic.is_published ? "published" : "subscribed to") << " | " << topic.note << " |\n";
  }
  page << "\n";
  return page.str();
}

std::string support_page() {
  return "# What acts, what is warned about, what is refused\n\n"
         "<!-- Made by `rosrun ardee_sim_cpp support_page > docs/support.md`; a test compares. "
         "-->\n\n"
         "Whatever a world, a robot or a service call says\n\n"
         "- **acts**, as in Gazebo Classic; or asks for what happens anyway, or for what Gazebo "
         "does "
         "nothing with either (*nothing to do*);\n"
         "- is known and has no effect here: one **warning** with file, line and reason, and a "
         "count "
         "where it stands several times. What says\n  the same as its absence gives none;\n"
         "- is unknown: one warning with file and line. Elements and attributes of other XML "
         "namespaces than `ardee:` are left to their\n  owners;\n"
         "- has no possible meaning (not a number, a radius below zero, a joint to a link that is "
         "not "
         "there): it is **refused** as a whole, with\n  one message that says file, line, what was "
         "found and what was expected.\n\n" +
         elements_in_markdown() + plugins_in_markdown() + node_in_markdown();
}

}  // namespace ardee
