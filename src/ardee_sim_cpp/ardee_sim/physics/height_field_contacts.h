// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "ardee_sim/core/pose.h"
#include "ardee_sim/description/geometry.h"
#include "ardee_sim/physics/height_field.h"
#include "ardee_sim/physics/vertex_tree.h"

namespace ardee::physics {

/// A point where a shape overlaps another, or reaches below the ground. The normal points from the
/// second shape, or out of the ground, into the first; moving the first along it by `depth_m` frees
/// this point.
struct ContactPoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
  double depth_m = 0.0;
  double share = 1.0;  // of the surfaces' stiffness
};
using ContactPoints = std::vector<ContactPoint>;

/// Vertical depth of a point below the ground, with the ground's normal there; negative above the
/// ground, minus infinity outside the field.
double depth_below(const HeightField& field, const Eigen::Vector3d& point, Eigen::Vector3d& normal);

/// Adds a contact unless one exists at that point.
void add_contact(const ContactPoint& contact, ContactPoints& contacts);

/// Adds a contact at a point of a shape if it lies below the ground.
void add_point(const HeightField& field, const Eigen::Vector3d& point, ContactPoints& contacts);

/// All poses are in the field's frame. Contacts are appended in a fixed order.
void collide_sphere(const HeightField& field, const Eigen::Vector3d& center, double radius_m,
                    ContactPoints& contacts);

/// A cylinder on its side touches with its two rims and its middle, on which a wheel as wide as it
/// is rolls, together as stiff as the rims alone: each is a circle whose deepest points over faces
/// and over convex edges of the ground are found in closed form, so that a rolling wheel meets no
/// steps. A cylinder on end touches with eight points of the lower rim.
void collide_cylinder(const HeightField& field, const Pose& X_FC, const Cylinder& cylinder,
                      ContactPoints& contacts);

/// Corners of the box, points of its edges over ridges, and peaks of the ground inside the box.
void collide_box(const HeightField& field, const Pose& X_FB, const Box& box,
                 ContactPoints& contacts);

/// Vertices, each times `scale`, below the ground.
void collide_vertices(const HeightField& field, const Pose& X_FV, double scale,
                      const VertexTree& vertices, ContactPoints& contacts);

/// Keeps at most `max_contacts`: the deepest, then each time the one farthest from those kept.
void reduce_contacts(ContactPoints& contacts, std::size_t max_contacts);

}  // namespace ardee::physics
