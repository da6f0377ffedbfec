// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/contact_joints.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ardee::physics {
namespace {

constexpr double kMaxStiffness = 1e15;    // N/m, N s/m: rigid in practice
constexpr double kLeastStiffness = 1e-6;  // N s/m: none in practice
constexpr double kSlidingSpeed = 0.02;    // m/s: a slower contact sticks in part

/// The first friction direction in the world: that of the first surface that has one, along the
/// contact plane.
std::optional<Eigen::Vector3d> friction_direction(const ContactSide& a, const ContactSide& b,
                                                  const Eigen::Vector3d& normal) {
  for (const ContactSide* side : {&a, &b}) {
    const Eigen::Vector3d& fdir1 = side->shape->collision->surface.fdir1;
    if (fdir1.squaredNorm() < 1e-18) continue;
    const Eigen::Vector3d direction = shape_rotation(*side->shape) * fdir1.normalized();
    const Eigen::Vector3d tangent = direction - direction.dot(normal) * normal;
    if (tangent.norm() < 1e-6) return std::nullopt;
    return tangent.normalized();
  }
  return std::nullopt;
}

void copy(const Eigen::Vector3d& from, dReal* to) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

Eigen::Vector3d velocity_at(dBodyID body, const Eigen::Vector3d& p) {
  if (!body) return Eigen::Vector3d::Zero();
  dVector3 velocity;
  dBodyGetPointVel(body, p.x(), p.y(), p.z(), velocity);
  return to_vector(velocity);
}

/// Coulomb's friction within ODE's pyramid: while a contact slides, each axis carries the share
/// that dissipates the most, (mu^2 v1, mu2^2 v2) / |(mu v1, mu2 v2)|, which for mu = mu2 points
/// against the sliding; while it sticks, both carry their full limit. With the pyramid alone, whose
/// axes slide independently, a skid-steering robot turns about its heavier axle, or not at all.
void narrow_to_cone(const Eigen::Vector3d& sliding, const Eigen::Vector3d& normal,
                    dContact& contact) {
  if (std::isinf(contact.surface.mu) || std::isinf(contact.surface.mu2)) return;  // never slides
  const Eigen::Vector3d first = to_vector(contact.fdir1);
  const double grip1 = contact.surface.mu * std::abs(sliding.dot(first));
  const double grip2 = contact.surface.mu2 * std::abs(sliding.dot(normal.cross(first)));
  const double grip = std::hypot(grip1, grip2);
  if (!(grip > 0.0)) return;
  const double speed = grip / std::max(contact.surface.mu, contact.surface.mu2);
  const double slides = std::min(1.0, speed / kSlidingSpeed);
  contact.surface.mu *= 1.0 - slides * (1.0 - grip1 / grip);
  contact.surface.mu2 *= 1.0 - slides * (1.0 - grip2 / grip);
}

/// Depth that a body may have in another before it is pushed out: that of its surface, which
/// replaces the world's layer. A surface without a depth has none in Gazebo either; here it keeps
/// at most ODE's default layer, so that the body rests and does not hop.
double own_layer(const ContactSide& side, const PhysicsParams& params) {
  constexpr double kDefaultLayer_m = 0.001;
  if (!side.body) return dInfinity;
  const double own_m = side.shape->collision->surface.min_depth_m;
  return own_m > 0.0 ? own_m : std::min(params.contact_surface_layer_m, kDefaultLayer_m);
}

/// Greatest speed at which a body is pushed out.
double own_push(const ContactSide& side) {
  const double own = side.shape->collision->surface.max_correcting_velocity_m_per_s;
  return side.body && own >= 0.0 ? own : dInfinity;
}

/// Radius of the sphere whose contact with a plane equals that of two spheres; zero: flat.
double combine_radii(double a_m, double b_m) {
  if (a_m > 0.0 && b_m > 0.0) return 1.0 / (1.0 / a_m + 1.0 / b_m);
  return std::max(a_m, b_m);
}

/// Friction against turning about the normal, as a lever of the normal force (m): that of a round
/// patch under Hertz's pressure.
double spinning_lever(const ContactParameters& law, double depth_m) {
  const double radius_m =
      law.use_patch_radius ? law.patch_radius_m : std::sqrt(law.surface_radius_m * depth_m);
  return radius_m > 0.0 ? 3.0 * M_PI / 16.0 * radius_m * law.torsional_mu : 0.0;
}

/// Wrench of a contact on scenery, which has no body, about the frame of its collision.
ForceTorque reaction(const ContactSide& a, const ContactSide& b, const ContactPoint& point,
                     const ForceTorque& on_a) {
  const Eigen::Vector3d arm = point.position - to_vector(dBodyGetPosition(a.body));
  const Eigen::Vector3d spin = on_a.torque - arm.cross(on_a.force);
  const Eigen::Vector3d force = -on_a.force;
  return {force, (point.position - b.shape->X_WS.p).cross(force) - spin};
}

/// The axis that ODE uses as the first one of its pyramid.
Eigen::Vector3d default_direction(const Eigen::Vector3d& normal) {
  dVector3 n, p, q;
  for (int i = 0; i < 3; ++i) n[i] = normal[i];
  dPlaneSpace(n, p, q);
  return to_vector(p);
}

}  // namespace

bool meet(const Surface& a, const Surface& b) {
  return ((a.category_bitmask & b.collide_bitmask) | (b.category_bitmask & a.collide_bitmask)) != 0;
}

bool is_forceless(const Surface& a, const Surface& b) {
  return a.collide_without_contact || b.collide_without_contact;
}

ContactParameters combine_surfaces(const ContactSide& side_a, const ContactSide& side_b,
                                   const PhysicsParams& params) {
  const Surface& a = side_a.shape->collision->surface;
  const Surface& b = side_b.shape->collision->surface;
  ContactParameters law;
  law.mu = std::min(a.mu, b.mu);
  law.mu2 = std::min(a.mu2, b.mu2);
  law.friction_cone = a.friction_cone && b.friction_cone;
  law.slip1 = a.slip1 + b.slip1;
  law.slip2 = a.slip2 + b.slip2;
  law.torsional_mu = std::min(a.torsional_mu, b.torsional_mu);
  law.use_patch_radius = a.use_patch_radius && b.use_patch_radius;
  law.patch_radius_m = std::max(a.patch_radius_m, b.patch_radius_m);
  law.surface_radius_m = combine_radii(a.surface_radius_m, b.surface_radius_m);
  const double kp = std::min(1.0 / (1.0 / a.kp_n_per_m + 1.0 / b.kp_n_per_m), kMaxStiffness);
  const double kd = std::min(a.kd_n_s_per_m + b.kd_n_s_per_m, kMaxStiffness);
  const double total = std::max(params.step_s * kp + kd, kLeastStiffness);
  law.erp = params.step_s * kp / total;
  law.cfm = 1.0 / total;
  law.min_depth_m = std::min(own_layer(side_a, params), own_layer(side_b, params));
  const double weight_n =
      side_b.body ? std::min(side_a.weight_n, side_b.weight_n) : side_a.weight_n;
  law.max_push_m_per_s =
      std::min({params.max_correcting_velocity_m_per_s, own_push(side_a), own_push(side_b)}) +
      2.0 * weight_n * law.cfm;
  law.restitution = std::min(a.restitution, b.restitution);
  law.bounce_threshold_m_per_s = std::min(a.bounce_threshold_m_per_s, b.bounce_threshold_m_per_s);
  return law;
}

ContactJoints::ContactJoints(dWorldID world) : world_(world), group_(dJointGroupCreate(0)) {}

void ContactJoints::clear() {
  dJointGroupEmpty(group_.get());
  count_ = 0;
  to_tell_.clear();
}

std::vector<Contact> ContactJoints::contacts() const {
  std::vector<Contact> made;
  for (const Told& each : to_tell_) {
    const dJointFeedback& given = each.feedback;
    Contact& contact = made.emplace_back();
    contact.collision1 = each.a.shape->scoped_name();
    contact.collision2 = each.b.shape->scoped_name();
    contact.position = each.point.position;
    contact.normal = each.point.normal;
    contact.depth_m = each.point.depth_m;
    contact.on1 = {to_vector(given.f1), to_vector(given.t1)};
    contact.on2 = each.b.body ? ForceTorque{to_vector(given.f2), to_vector(given.t2)}
                              : reaction(each.a, each.b, each.point, contact.on1);
  }
  return made;
}

void ContactJoints::join(const ContactSide& a, const ContactSide& b, const ContactParameters& law,
                         double step_s, const ContactPoint& point) {
  dContact contact{};
  contact.surface.mode = dContactApprox1 | dContactMu2 | dContactSoftERP | dContactSoftCFM;
  contact.surface.mu = law.mu;
  contact.surface.mu2 = law.mu2;
  contact.surface.soft_erp = law.erp;
  contact.surface.soft_cfm = law.cfm / point.share;
  if (law.restitution > 0.0) {
    contact.surface.mode |= dContactBounce;
    contact.surface.bounce = law.restitution;
    contact.surface.bounce_vel = law.bounce_threshold_m_per_s;
  }
  if (law.slip1 > 0.0) contact.surface.mode |= dContactSlip1;
  if (law.slip2 > 0.0) contact.surface.mode |= dContactSlip2;
  contact.surface.slip1 = law.slip1;
  contact.surface.slip2 = law.slip2;
  copy(point.position, contact.geom.pos);
  copy(point.normal, contact.geom.normal);
  contact.surface.rhoN = spinning_lever(law, point.depth_m);
  if (contact.surface.rhoN > 0.0) contact.surface.mode |= dContactRolling;
  // The engine has one layer and one greatest push for all contacts; here each contact has its own,
  // so the push is computed here and passed on as the depth that produces it.
  const double rate = law.erp / step_s;
  const double push =
      std::min(rate * std::max(0.0, point.depth_m - law.min_depth_m), law.max_push_m_per_s);
  contact.geom.depth = rate > 0.0 ? push / rate : 0.0;
  contact.surface.mode |= dContactFDir1;
  copy(friction_direction(a, b, point.normal).value_or(default_direction(point.normal)),
       contact.fdir1);
  if (law.friction_cone) {
    const Eigen::Vector3d& p = point.position;
    narrow_to_cone(velocity_at(a.body, p) - velocity_at(b.body, p), point.normal, contact);
  }
  dJointID joint = dJointCreateContact(world_, group_.get(), &contact);
  dJointAttach(joint, a.body, b.body);
  ++count_;
  if (!told_) return;
  to_tell_.push_back({a, b, point});
  dJointSetFeedback(joint, &to_tell_.back().feedback);
}

void ContactJoints::collide(const ContactSide& a, const ContactSide& b,
                            const PhysicsParams& params) {
  const Surface& surface_a = a.shape->collision->surface;
  const Surface& surface_b = b.shape->collision->surface;
  if (!meet(surface_a, surface_b)) return;
  const bool forceless = is_forceless(surface_a, surface_b);
  if (forceless && !told_) return;
  points_.clear();
  const int most = std::min({params.max_contacts, surface_a.max_contacts, surface_b.max_contacts});
  collide_shapes(*a.shape, *b.shape, most, points_);
  if (points_.empty()) return;
  if (forceless) {
    for (const ContactPoint& point : points_) to_tell_.push_back({a, b, point});
    return;
  }
  const ContactParameters law = combine_surfaces(a, b, params);
  for (const ContactPoint& point : points_) join(a, b, law, params.step_s, point);
}

}  // namespace ardee::physics
