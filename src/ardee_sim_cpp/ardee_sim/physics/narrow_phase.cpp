// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/narrow_phase.h"

#include <algorithm>
#include <array>
#include <optional>

namespace ardee::physics {
namespace {

constexpr int kMaxPoints = 64;
constexpr int kLeastOfCylinder = 3;   // two ends and the middle
constexpr double kLying = 0.1;        // |cos| of a cylinder's axis to a contact's normal
constexpr double kSameNormal = 0.99;  // cos between two contacts of one flat ground
constexpr double kLeastWidth = 1e-4;  // m: nearer contacts are merged

Pose geom_pose(dGeomID geom) {
  dQuaternion q;
  dGeomGetQuaternion(geom, q);
  return {to_vector(dGeomGetPosition(geom)), to_quaternion(q)};
}

/// The middle of a lying cylinder replaces its ends if few contacts are wanted.
void keep_nearest(const Eigen::Vector3d& center, int max_contacts, ContactPoints& contacts) {
  const auto nearest = std::min_element(
      contacts.begin(), contacts.end(), [&center](const ContactPoint& a, const ContactPoint& b) {
        return (a.position - center).squaredNorm() < (b.position - center).squaredNorm();
      });
  if (nearest == contacts.end()) return;
  const double share = std::min<double>(max_contacts, static_cast<double>(contacts.size()));
  contacts = {*nearest};
  contacts.front().share = share;
}

/// Finds the points of a shape below a field, in the field's own frame and unscaled metres: the
/// shape is divided by the field's scale instead.
struct OnField {
  const CollisionShape& shape;
  const HeightField& field;
  const Pose& X_FS;
  double shrink;
  int max_contacts;
  ContactPoints& contacts;

  void operator()(const Sphere& sphere) const {
    collide_sphere(field, X_FS.p, shape.scale * shrink * sphere.radius_m, contacts);
  }
  void operator()(const Cylinder& cylinder) const {
    const double scale = shape.scale * shrink;
    collide_cylinder(field, X_FS, {scale * cylinder.radius_m, scale * cylinder.length_m}, contacts);
    if (max_contacts < kLeastOfCylinder) keep_nearest(X_FS.p, max_contacts, contacts);
  }
  void operator()(const Box& box) const {
    collide_box(field, X_FS, {shape.scale * shrink * box.size_m}, contacts);
  }
  /// The mesh's vertices carry the shape's own scale already.
  void operator()(const Mesh&) const {
    collide_vertices(field, X_FS, shrink, *shape.mesh->tree, contacts);
  }
  /// Two grounds have no contacts.
  void operator()(const Plane&) const {}
  void operator()(const Heightmap&) const {}
};

void collide_field(const CollisionShape& shape, const CollisionShape& ground, int max_contacts,
                   ContactPoints& points) {
  if (!shape.geom) return;
  const double shrink = 1.0 / ground.scale;
  Pose X_FS = ground.X_WS.inverse() * geom_pose(shape.geom.get());
  X_FS.p *= shrink;
  ContactPoints contacts;
  std::visit(OnField{shape, *ground.field, X_FS, shrink, max_contacts, contacts},
             shape.collision->geometry);
  reduce_contacts(contacts, static_cast<std::size_t>(max_contacts));
  for (const ContactPoint& contact : contacts) {
    points.push_back({ground.X_WS * (ground.scale * contact.position),
                      ground.X_WS.q * contact.normal, ground.scale * contact.depth_m,
                      contact.share});
  }
}

/// The deepest vertices of a mesh below a plane, spread out: of too many, ODE would take the first
/// that it finds.
void collide_plane(const CollisionShape& shape, dGeomID plane, int max_contacts,
                   ContactPoints& points) {
  dVector4 equation;
  dGeomPlaneGetParams(plane, equation);
  const Eigen::Vector3d normal = to_vector(equation);
  const Pose X_WS = geom_pose(shape.geom.get());
  const Eigen::Vector3d normal_S = X_WS.q.conjugate() * normal;
  const double height_m = equation[3] - normal.dot(X_WS.p);
  const Eigen::Vector3d spread = normal_S.cwiseAbs();
  ContactPoints contacts;
  shape.mesh->tree->visit(
      [&](const Eigen::AlignedBox3f& box) {
        return normal_S.dot(box.center().cast<double>()) -
                   0.5 * spread.dot(box.sizes().cast<double>()) <
               height_m;
      },
      [&](const Eigen::Vector3f& vertex) {
        const Eigen::Vector3d point = vertex.cast<double>();
        const double depth_m = height_m - normal_S.dot(point);
        if (depth_m > 0.0) contacts.push_back({X_WS * point, normal, depth_m});
      });
  reduce_contacts(contacts, static_cast<std::size_t>(max_contacts));
  points.insert(points.end(), contacts.begin(), contacts.end());
}

void collide_geoms(dGeomID a, dGeomID b, int max_contacts, ContactPoints& points) {
  std::array<dContactGeom, kMaxPoints> found;
  const int count = dCollide(a, b, std::min(max_contacts, kMaxPoints), found.data(),
                             static_cast<int>(sizeof(dContactGeom)));
  for (int i = 0; i < count; ++i) {
    const dContactGeom& contact = found[static_cast<std::size_t>(i)];
    points.push_back({to_vector(contact.pos), to_vector(contact.normal), contact.depth});
  }
}

bool is_cylinder(const CollisionShape& shape) {
  return std::holds_alternative<Cylinder>(shape.collision->geometry);
}

/// Contacts of the two ends of a lying cylinder, or nothing if it does not lie.
std::optional<ContactPoint> middle_of(const CollisionShape& cylinder, const ContactPoints& points) {
  const Pose X_WS = geom_pose(cylinder.geom.get());
  const Eigen::Vector3d axis = X_WS.q * Eigen::Vector3d::UnitZ();
  const ContactPoint *low = nullptr, *high = nullptr;
  double low_m = 0.0, high_m = 0.0;
  for (const ContactPoint& point : points) {
    if (std::abs(point.normal.dot(axis)) > kLying) return std::nullopt;
    const double along_m = axis.dot(point.position - X_WS.p);
    if (!low || along_m < low_m) low = &point, low_m = along_m;
    if (!high || along_m > high_m) high = &point, high_m = along_m;
  }
  if (!low || high_m - low_m < kLeastWidth) return std::nullopt;
  if (low->normal.dot(high->normal) < kSameNormal) return std::nullopt;
  return ContactPoint{0.5 * (low->position + high->position),
                      (low->normal + high->normal).normalized(),
                      0.5 * (low->depth_m + high->depth_m)};
}

/// Two touching ends of a lying cylinder do not define where it rolls: the solver may put the whole
/// load on either of them. A third contact between them is the rolling point of a wheel of that
/// width; if fewer contacts are wanted, it replaces all. Together they are as stiff as the two ends
/// alone.
void collide_cylinder_geoms(const CollisionShape& cylinder, dGeomID a, dGeomID b, int max_contacts,
                            ContactPoints& points) {
  collide_geoms(a, b, std::max(max_contacts, kLeastOfCylinder), points);
  const auto most = static_cast<std::size_t>(max_contacts);
  auto middle = middle_of(cylinder, points);
  if (middle && max_contacts < kLeastOfCylinder) {
    middle->share = std::min<double>(max_contacts, static_cast<double>(points.size()));
    points.assign(1, *middle);
    return;
  }
  if (points.size() > most) points.resize(most);
  if (!middle) return;
  const auto count = static_cast<double>(points.size());
  points.push_back(*middle);
  for (ContactPoint& point : points) point.share = count / (count + 1.0);
}

}  // namespace

void collide_shapes(const CollisionShape& a, const CollisionShape& b, int max_contacts,
                    ContactPoints& points) {
  if (max_contacts < 1) return;
  if (b.field) {
    collide_field(a, b, max_contacts, points);
  } else if (a.mesh && std::holds_alternative<Plane>(b.collision->geometry)) {
    collide_plane(a, b.geom.get(), max_contacts, points);
  } else if (a.geom && b.geom) {
    const CollisionShape* cylinder = is_cylinder(a) ? &a : is_cylinder(b) ? &b : nullptr;
    if (cylinder) {
      collide_cylinder_geoms(*cylinder, a.geom.get(), b.geom.get(), max_contacts, points);
    } else {
      collide_geoms(a.geom.get(), b.geom.get(), max_contacts, points);
    }
  }
}

}  // namespace ardee::physics
