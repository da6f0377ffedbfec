// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "ardee_sim/raycast/local_scene.h"
#include "ardee_sim/raycast/moving_models.h"

namespace ardee::raycast {

/// Models of one simulation that a picture's rays must test beside the triangle scene of a local
/// scene, which may serve other simulations too.
class ModelsBeside {
 public:
  /// `since`: when the models at rest were taken into the local scene.
  explicit ModelsBeside(std::uint64_t since) : since_(since) {}

  /// Finds them among models as they stand now.
  void find(const LocalScene& local, const MovingModels& moving);

  const ModelList& models() const { return models_; }
  /// Returns whether so many of them are in the tree of models at rest that the tree is quicker.
  bool ask_tree() const { return ask_tree_; }
  /// Returns whether a model at rest lies beyond the local scene.
  bool are_beyond() const { return are_beyond_; }
  /// Returns whether enough of them have come to rest to justify another local scene.
  bool outdate() const { return outdate_; }
  /// Returns whether one of them, or one that has left its place in the triangle scene, may stand
  /// between a place (within `about_m`) and a lamp.
  bool may_shade(const Eigen::Vector3f& at_W, const Eigen::Vector3f& to_lamp_W,
                 float about_m) const;

 private:
  std::uint64_t since_;
  ModelList models_;
  std::vector<ShadowBall> gone_;  // places that models at rest have left
  bool are_beyond_ = false;
  bool ask_tree_ = false;
  bool outdate_ = false;
};

}  // namespace ardee::raycast
