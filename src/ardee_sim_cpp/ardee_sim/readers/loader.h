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

/// Reads worlds and models, SDF 1.2-1.12 or URDF, into plain descriptions. Files (models, meshes,
/// heightmap images, material scripts) are read once and shared by all references to them. Throws
/// Error, and keeps nothing then. With kLeaveOut a missing include, mesh or heightmap, and each
/// malformed model, include or light of a world, is an error in the log and the rest is read; a
/// file that is not XML or SDF at all is still refused.
class Loader {
 public:
  Loader(ResourceLocator locator, Log log, BadParts bad_parts = BadParts::kRefuse);
  ~Loader();
  Loader(Loader&&) noexcept;

  World load_world(const std::string& path);
  /// `name` denotes the file in messages.
  World load_world_text(const std::string& xml, const std::string& name);
  /// SDF (<sdf><model>) or URDF (<robot>), told apart by the root element.
  std::shared_ptr<const Model> load_model(const std::string& path);
  std::shared_ptr<const Model> load_model_text(const std::string& xml, const std::string& name);
  /// Reads a model as above, or the light of an SDF without a model.
  std::variant<std::shared_ptr<const Model>, Light> load_model_or_light_text(
      const std::string& xml, const std::string& name);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ardee
