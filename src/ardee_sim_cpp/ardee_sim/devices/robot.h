// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/physics_world.h"

namespace ardee::devices {

/// A model in the world as its devices see it: its description, and the present poses of its links.
/// A static model has a fixed pose and no dynamics.
class Robot {
 public:
  Robot(std::string name, std::shared_ptr<const Model> model, std::uint32_t entity)
      : name_(std::move(name)), model_(std::move(model)), entity_(entity) {}

  const std::string& name() const { return name_; }
  const Model& model() const { return *model_; }
  std::shared_ptr<const Model> shared_model() const { return model_; }
  /// Number of the robot in the ray scenes.
  std::uint32_t entity() const { return entity_; }

  /// Seed of the noise of the robot's sensors, beside that of their streams; 0: no other.
  std::uint64_t noise_seed() const { return noise_seed_; }
  /// Takes effect when the devices are reset.
  void set_noise_seed(std::uint64_t seed) { noise_seed_ = seed; }

  bool is_dynamic() const { return dynamics_ != nullptr; }
  /// Throws Error if the model is static.
  physics::PhysicsModel& dynamics() const;
  /// Sets the moving state; a static model has nullptr and a fixed pose.
  void attach(physics::PhysicsModel* dynamics) { dynamics_ = dynamics; }
  void place(const Pose& X_WM) { fixed_pose_ = X_WM; }

  Pose pose() const { return dynamics_ ? dynamics_->pose() : fixed_pose_; }
  Pose link_pose(std::size_t link) const;
  Twist link_twist(std::size_t link) const;
  /// Velocity of the model's frame, which moves with the canonical link; axes of the world.
  Twist twist() const;
  /// Planar part of twist(), as the odometry of the stock drives gives it: forwards, to the left,
  /// and the turn, all seen from above.
  Twist planar_twist() const;
  /// Index of the link scope + link_name ("arm::" + "hand"), or if there is none, of link_name.
  /// Throws Error at `source` if there is neither.
  std::size_t link_index(const std::string& link_name, const Source& source,
                         const std::string& scope = "") const;
  std::size_t joint_index(const std::string& joint_name, const Source& source,
                          const std::string& scope = "") const;

 private:
  std::string name_;
  std::shared_ptr<const Model> model_;
  std::uint32_t entity_;
  physics::PhysicsModel* dynamics_ = nullptr;
  Pose fixed_pose_;
  std::uint64_t noise_seed_ = 0;
};

}  // namespace ardee::devices
