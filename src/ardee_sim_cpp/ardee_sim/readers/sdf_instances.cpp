// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/instance_table.h"
#include "ardee_sim/readers/limits.h"
#include "ardee_sim/readers/sdf_reader.h"

namespace ardee {

void SdfReader::read_instances(const Node& node, UniqueNames& names, Model& made) {
  if (!made.is_static) throw node.error("found this element, expected it in static models only");
  const std::string path = assets_.locator().resolve(node.required_text(), node.source());
  std::map<std::string, std::shared_ptr<const Model>, std::less<>> models;  // by URI
  read_instance_table(path, node.source(), [&](const InstanceRow& row) {
    auto known = models.find(row.model);
    if (known == models.end()) {
      const Source source{path, row.line, ""};
      const std::string uri(row.model);
      const ModelFile& file = included_file(uri, source, true);
      if (!file.model && !file.lights.empty()) {
        throw Error(source, "found lights alone in '" + uri + "', expected a model");
      }
      known = models.emplace(uri, file.model).first;
    }
    if (!known->second) return;
    if (made.instances.size() == kMaxPlacements) {
      throw Error(Source{path, row.line, ""}, "found more than " + std::to_string(kMaxPlacements) +
                                                  " instances, expected fewer");
    }
    made.instances.push_back(
        {known->second, names.claim(std::string(row.name)), row.pose, row.scale, row.label, true});
  });
}

}  // namespace ardee
