// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/collision_shape.h"

#include <limits>

#include "ardee_sim/core/error.h"
#include "ardee_sim/description/bounds.h"
#include "ardee_sim/description/shape_fault.h"

namespace ardee::physics {
namespace {

bool is_valid(const Surface& surface) {
  return bounds::kFriction.holds(surface.mu) && bounds::kFriction.holds(surface.mu2) &&
         bounds::kSlip.holds(surface.slip1) && bounds::kSlip.holds(surface.slip2) &&
         bounds::kStiffness.holds(surface.kp_n_per_m) &&
         bounds::kDamping.holds(surface.kd_n_s_per_m) &&
         bounds::kMinDepth.holds(surface.min_depth_m) &&
         bounds::kMaxVelocity.holds(surface.max_correcting_velocity_m_per_s) &&
         bounds::kRestitution.holds(surface.restitution) &&
         bounds::kBounceThreshold.holds(surface.bounce_threshold_m_per_s) &&
         bounds::kFriction.holds(surface.torsional_mu) &&
         bounds::kRadius_m.holds(surface.patch_radius_m) &&
         bounds::kRadius_m.holds(surface.surface_radius_m) && surface.fdir1.allFinite();
}

Eigen::AlignedBox3d transformed(const Eigen::AlignedBox3d& box, const Pose& X_WS) {
  const Eigen::Vector3d center = X_WS * box.center();
  const Eigen::Vector3d reach = X_WS.q.toRotationMatrix().cwiseAbs() * (0.5 * box.sizes());
  return {center - reach, center + reach};
}

struct Bounds {
  double scale;
  const Pose& X_WS;

  Eigen::AlignedBox3d operator()(const Box& box) const {
    const Eigen::Vector3d half = 0.5 * scale * box.size_m;
    return transformed({-half, half}, X_WS);
  }
  Eigen::AlignedBox3d operator()(const Sphere& sphere) const {
    const Eigen::Vector3d reach = Eigen::Vector3d::Constant(scale * sphere.radius_m);
    return {X_WS.p - reach, X_WS.p + reach};
  }
  Eigen::AlignedBox3d operator()(const Cylinder& cylinder) const {
    const Eigen::Vector3d axis = X_WS.q * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d across =
        (Eigen::Vector3d::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    const Eigen::Vector3d reach =
        scale * (0.5 * cylinder.length_m * axis.cwiseAbs() + cylinder.radius_m * across);
    return {X_WS.p - reach, X_WS.p + reach};
  }
  Eigen::AlignedBox3d operator()(const Plane&) const {
    const Eigen::Vector3d far = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    return {-far, far};
  }
  Eigen::AlignedBox3d operator()(const Mesh& mesh) const {
    const Eigen::AlignedBox3d box = mesh_bounds(mesh);
    return transformed({scale * box.min(), scale * box.max()}, X_WS);
  }
  Eigen::AlignedBox3d operator()(const Heightmap& heightmap) const {
    const Eigen::AlignedBox3d box = HeightField(heightmap.grid).bounds();
    return transformed({scale * box.min(), scale * box.max()}, X_WS);
  }
};

void place(dGeomID geom, const Pose& X_WS) {
  const dQuaternion q = {X_WS.q.w(), X_WS.q.x(), X_WS.q.y(), X_WS.q.z()};
  dGeomSetPosition(geom, X_WS.p.x(), X_WS.p.y(), X_WS.p.z());
  dGeomSetQuaternion(geom, q);
}

}  // namespace

void check_collision(const Model& model, const Link& link, const Collision& collision) {
  const auto wrong_shape = find_fault(collision.geometry);
  std::string fault = wrong_shape ? wrong_shape->message() : "";
  if (!collision.X_LC.is_finite()) fault = "found a pose that is not finite";
  if (!is_valid(collision.surface)) fault = "found a number of its surface that is out of bounds";
  if (fault.empty()) return;
  throw Error(link.source, "model '" + model.name + "', link '" + link.name + "', collision '" +
                               collision.name + "': " + fault);
}

Eigen::AlignedBox3d shape_bounds(const Geometry& geometry, double scale, const Pose& X_WS) {
  return std::visit(Bounds{scale, X_WS}, geometry);
}

Pose shape_pose(const Collision& collision, const Pose& X_WC, double scale) {
  const auto* heightmap = std::get_if<Heightmap>(&collision.geometry);
  if (!heightmap) return X_WC;
  return X_WC * Pose{scale * heightmap->position_m, Eigen::Quaterniond::Identity()};
}

/// Creates the contact geometry of a shape with known collision, scale and pose.
struct ShapeFactory::Make {
  ShapeFactory& factory;
  CollisionShape& shape;

  void operator()(const Box& box) const {
    const Eigen::Vector3d size = shape.scale * box.size_m;
    put(dCreateBox(nullptr, size.x(), size.y(), size.z()));
  }
  void operator()(const Sphere& sphere) const {
    put(dCreateSphere(nullptr, shape.scale * sphere.radius_m));
  }
  void operator()(const Cylinder& cylinder) const {
    put(dCreateCylinder(nullptr, shape.scale * cylinder.radius_m, shape.scale * cylinder.length_m));
  }
  /// ODE's planes have no pose.
  void operator()(const Plane& plane) const {
    const Eigen::Vector3d normal = shape.X_WS.q * plane.normal.normalized();
    shape.geom.reset(
        dCreatePlane(nullptr, normal.x(), normal.y(), normal.z(), normal.dot(shape.X_WS.p)));
  }
  void operator()(const Mesh& mesh) const {
    shape.mesh = factory.meshes_.get(mesh, shape.scale);
    put(dCreateTriMesh(nullptr, shape.mesh->data.get(), nullptr, nullptr, nullptr));
  }
  void operator()(const Heightmap& heightmap) const {
    std::weak_ptr<const HeightField>& slot = factory.fields_[heightmap.grid.get()];
    shape.field = slot.lock();
    if (shape.field) return;
    shape.field = std::make_shared<const HeightField>(heightmap.grid);
    slot = shape.field;
  }

  void put(dGeomID geom) const {
    shape.geom.reset(geom);
    place(geom, shape.X_WS);
  }
};

CollisionShape ShapeFactory::make(const Collision& collision, const Pose& X_WC, double scale) {
  CollisionShape shape;
  shape.collision = &collision;
  shape.scale = scale;
  shape.X_WS = shape_pose(collision, X_WC, scale);
  shape.bounds = shape_bounds(collision.geometry, scale, shape.X_WS);
  std::visit(Make{*this, shape}, collision.geometry);
  return shape;
}

Eigen::Matrix3d shape_rotation(const CollisionShape& shape) {
  if (shape.field || std::holds_alternative<Plane>(shape.collision->geometry)) {
    return shape.X_WS.q.toRotationMatrix();
  }
  return to_matrix(dGeomGetRotation(shape.geom.get()));
}

}  // namespace ardee::physics
