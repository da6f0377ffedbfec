// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

namespace ardee::raycast {

/// Half-line in some frame; lengths along it are in units of the direction.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;

  Eigen::Vector3d at(double t) const { return origin + t * direction; }
};

struct TriangleHit {
  double t = 0.0;
  Eigen::Vector3d normal;   // (v1 - v0) x (v2 - v0)
  Eigen::Vector3d weights;  // of v0, v1, v2
};

/// Intersects the line of the ray with a triangle, t >= 0. Rays cannot slip between triangles that
/// share two vertices: the sign that decides about an edge is the exact negative of the sign for
/// its neighbour, and zero counts as inside.
bool intersect_triangle(const Ray& ray, const Eigen::Vector3d& v0, const Eigen::Vector3d& v1,
                        const Eigen::Vector3d& v2, TriangleHit& hit);

/// Stretch of a ray's line within a convex solid, with outward normals; either end may lie behind
/// the origin.
struct RayInterval {
  double t_in = 0.0;
  double t_out = 0.0;
  Eigen::Vector3d normal_in;
  Eigen::Vector3d normal_out;
};

/// Intersect solids centred at the origin; the cylinder stands along z.
bool intersect_sphere(const Ray& ray, double radius, RayInterval& chord);
bool intersect_box(const Ray& ray, const Eigen::Vector3d& half_size, RayInterval& chord);
bool intersect_cylinder(const Ray& ray, double radius, double half_length, RayInterval& chord);

/// Intersects the plane z = 0, t >= 0.
bool intersect_ground(const Ray& ray, double& t);

}  // namespace ardee::raycast
