// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/sdf_parts.h"

namespace ardee {

Material read_sdf_material(const Node& material, Assets& assets) {
  Material made;
  bool scripted = false;
  if (const auto script = material.child("script")) {
    std::vector<std::string> uris;
    script->each("uri", [&uris](const Node& uri) {
      if (const std::string text = uri.text(); !text.empty()) uris.push_back(text);
    });
    if (const std::string name = script->text("name", ""); !name.empty()) {
      made = assets.material(name, uris, script->required("name").source());
      scripted = true;
    } else {
      assets.log().warn(script->source(), "found no <name>, expected a material's; left out");
    }
  }
  made.diffuse = material.color("diffuse", made.diffuse);
  made.ambient = material.color("ambient", scripted ? made.ambient : made.diffuse);
  made.specular = material.color("specular", made.specular);
  made.emissive = material.color("emissive", made.emissive);
  return made;
}

}  // namespace ardee
