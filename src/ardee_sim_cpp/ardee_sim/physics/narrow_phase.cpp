// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/narrow_phase.h"

#include <algorithm>
#include <array>

#include "ardee_sim/physics/height_field_contacts.h"

namespace ardee::physics {
namespace {

constexpr int kMaxPoints = 64;

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

}  // namespace

void collide_shapes(const CollisionShape& a, const CollisionShape& b, int max_contacts,
                    std::vector<ContactPoint>& points) {
  if (max_contacts < 1) return;
  if (b.field) {
    collide_field(a, b, max_contacts, points);
  } else if (a.geom && b.geom) {
    collide_geoms(a.geom.get(), b.geom.get(), max_contacts, points);
  }
}

}  // namespace ardee::physics
