// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <variant>

#include "ardee_sim/core/bad_parts.h"
#include "ardee_sim/core/log.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/readers/resource_locator.h"

namespace ardee {

/// Reads worlds and models, SDF 1.2-1.12 or URDF, into plain descriptions. What is read once (model
/// files, meshes, heightmap images, material scripts) is shared by all that refer to it. Throws
/// Error; on a throw nothing is kept. With kLeaveOut a missing include, mesh or heightmap, and each
/// model, include or light of a world that is written wrong, is an error in the log and the rest is
/// read; what is no XML or SDF at all is refused all the same.
class Loader {
 public:
  Loader(ResourceLocator locator, Log log, BadParts bad_parts = BadParts::kRefuse);
  ~Loader();
  Loader(Loader&&) noexcept;

  World load_world(const std::string& path);
  /// `name` stands for the file in messages.
  World load_world_text(const std::string& xml, const std::string& name);
  /// SDF (<sdf><model>) or URDF (<robot>), told apart by the root element.
  std::shared_ptr<const Model> load_model(const std::string& path);
  std::shared_ptr<const Model> load_model_text(const std::string& xml, const std::string& name);
  /// The same, or the light of an SDF without a model.
  std::variant<std::shared_ptr<const Model>, Light> load_model_or_light_text(
      const std::string& xml, const std::string& name);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ardee
