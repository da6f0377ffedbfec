// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <string>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/model.h"
#include "ardee_sim/physics/height_field.h"
#include "ardee_sim/physics/ode_types.h"
#include "ardee_sim/physics/triangle_mesh.h"

namespace ardee::physics {

/// One collision of a link, ready to be tested. A heightmap has no geom: contacts with it are
/// computed here.
struct CollisionShape {
  const Collision* collision = nullptr;  // of a description that outlives the shape
  double scale = 1.0;
  GeomHandle geom;
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const HeightField> field;
  Pose X_WS;                   // at creation; a geom on a body moves away from it
  Eigen::AlignedBox3d bounds;  // at X_WS
  /// "model::link::collision", composed on request.
  std::function<std::string()> scoped_name;
  bool has_sensor = false;  // its link has a sensor, which may ask for contacts at any time
};

/// Throws Error naming model, link and collision if the shape, its pose or its surface is invalid.
void check_collision(const Model& model, const Link& link, const Collision& collision);

/// Bounds of a shape whose frame is at X_WS; infinite for a plane.
Eigen::AlignedBox3d shape_bounds(const Geometry& geometry, double scale, const Pose& X_WS);

/// Frame of the shape itself: the collision's, moved by a heightmap's own position.
Pose shape_pose(const Collision& collision, const Pose& X_WC, double scale);

/// Makes shapes. Descriptions that share a height grid share its field.
class ShapeFactory {
 public:
  /// Makes a shape at rest at X_WC, in no ODE space.
  CollisionShape make(const Collision& collision, const Pose& X_WC, double scale);

 private:
  struct Make;
  MeshCache meshes_;
  std::map<const HeightGrid*, std::weak_ptr<const HeightField>> fields_;
};

/// Rotation of the shape's frame, for directions given in it.
Eigen::Matrix3d shape_rotation(const CollisionShape& shape);

}  // namespace ardee::physics
