// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/narrow_phase.h"

#include <algorithm>
#include <array>

#include "ardee_sim/physics/height_field_contacts.h"

namespace ardee::physics {
namespace {

constexpr int kMaxPoints = 64;
constexpr double kLying = 0.1;        // |cos| of a cylinder's axis to a contact's normal
constexpr double kSameNormal = 0.99;  // cos between two contacts of one flat ground
constexpr double kLeastWidth = 1e-4;  // m: two contacts nearer than this are one

Pose geom_pose(dGeomID geom) {
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  return {to_vector(dGeomGetPosition(geom)), to_quaternion(q)};
}

/// Works in the field's own frame and unscaled metres: the shape is shrunk by the field's scale
/// instead.
void collide_field(const CollisionShape& shape, const CollisionShape& ground, int max_contacts,
                   std::vector<ContactPoint>& points) {
  if (!shape.geom) return;
  const HeightField& field = *ground.field;
  const double shrink = 1.0 / ground.scale;
  Pose X_FS = ground.X_WS.inverse() * geom_pose(shape.geom.get());
  X_FS.p *= shrink;
  GroundContacts contacts;
  const double scale = shape.scale * shrink;
  if (const auto* sphere = std::get_if<Sphere>(&shape.collision->geometry)) {
    collide_sphere(field, X_FS.p, scale * sphere->radius_m, contacts);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&shape.collision->geometry)) {
    collide_cylinder(field, X_FS, {scale * cylinder->radius_m, scale * cylinder->length_m},
                     contacts);
  } else if (const auto* box = std::get_if<Box>(&shape.collision->geometry)) {
    collide_box(field, X_FS, {scale * box->size_m}, contacts);
  } else if (shape.mesh) {
    // The mesh's vertices carry the shape's own scale already.
    collide_vertices(field, X_FS, shrink, shape.mesh->vertices, contacts);
  }
  reduce_contacts(contacts, static_cast<std::size_t>(max_contacts));
  for (const GroundContact& contact : contacts) {
    points.push_back({ground.X_WS * (ground.scale * contact.position),
                      ground.X_WS.q * contact.normal, ground.scale * contact.depth_m});
  }
}

void collide_geoms(dGeomID a, dGeomID b, int max_contacts, std::vector<ContactPoint>& points) {
  std::array<dContactGeom, kMaxPoints> found;
  const int count = dCollide(a, b, std::min(max_contacts, kMaxPoints), found.data(),
                             static_cast<int>(sizeof(dContactGeom)));
  for (int i = 0; i < count; ++i) {
    const dContactGeom& contact = found[static_cast<std::size_t>(i)];
    points.push_back({to_vector(contact.pos), to_vector(contact.normal), contact.depth});
  }
}

/// A cylinder that lies on its side is told from one that leans by the contacts of its two ends. The
/// solver may give all of the load to either, and the cylinder then rolls about that end: a third
/// contact between them is where a wheel as wide as it is rolls.
void add_middle(const CollisionShape& shape, std::size_t first, std::vector<ContactPoint>& points) {
  const Pose X_WS = geom_pose(shape.geom.get());
  const Eigen::Vector3d axis = X_WS.q * Eigen::Vector3d::UnitZ();
  const ContactPoint *low = nullptr, *high = nullptr;
  double low_m = 0.0, high_m = 0.0;
  for (std::size_t i = first; i < points.size(); ++i) {
    if (std::abs(points[i].normal.dot(axis)) > kLying) return;
    const double along_m = axis.dot(points[i].position - X_WS.p);
    if (!low || along_m < low_m) low = &points[i], low_m = along_m;
    if (!high || along_m > high_m) high = &points[i], high_m = along_m;
  }
  if (!low || high_m - low_m < kLeastWidth || low->normal.dot(high->normal) < kSameNormal) return;
  points.push_back({0.5 * (low->position + high->position),
                    (low->normal + high->normal).normalized(), 0.5 * (low->depth_m + high->depth_m)});
}

}  // namespace

void collide_shapes(const CollisionShape& a, const CollisionShape& b, int max_contacts,
                    std::vector<ContactPoint>& points) {
  if (max_contacts < 1) return;
  if (b.field) {
    collide_field(a, b, max_contacts, points);
  } else if (a.geom && b.geom) {
    const std::size_t first = points.size();
    collide_geoms(a.geom.get(), b.geom.get(), max_contacts, points);
    for (const CollisionShape* shape : {&a, &b}) {
      if (std::holds_alternative<Cylinder>(shape->collision->geometry)) {
        add_middle(*shape, first, points);
      }
    }
  }
}

}  // namespace ardee::physics
