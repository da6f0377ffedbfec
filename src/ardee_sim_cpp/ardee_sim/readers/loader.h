// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "ardee_sim/core/log.h"
#include "ardee_sim/description/world.h"
#include "ardee_sim/readers/resource_locator.h"

namespace ardee {

/// Reads worlds and models, SDF 1.2-1.12 or URDF, into plain descriptions. What is read once (model
/// files, meshes, heightmap images, material scripts) is shared by all that refer to it. Throws
/// Error; on a throw nothing is kept. With kLeaveOut a missing include, mesh or heightmap is an
/// error in the log and the rest is read; what is no XML or SDF at all is refused all the same.
class Loader {
 public:
  Loader(ResourceLocator locator, Log log, MissingFiles missing = MissingFiles::kRefuse);
  ~Loader();
  Loader(Loader&&) noexcept;

  World load_world(const std::string& path);
  /// `name` stands for the file in messages.
  World load_world_text(const std::string& xml, const std::string& name);
  /// SDF (<sdf><model>) or URDF (<robot>), told apart by the root element.
  std::shared_ptr<const Model> load_model(const std::string& path);
  std::shared_ptr<const Model> load_model_text(const std::string& xml, const std::string& name);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ardee
