// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/exact.h"

#include <cmath>
#include <limits>

namespace ardee::raycast {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Narrows a chord to the slab |coordinate| <= half along one axis.
bool clip_slab(const Ray& ray, int axis, double half, RayInterval& chord) {
  const double o = ray.origin[axis];
  const double d = ray.direction[axis];
  if (d == 0.0) return std::abs(o) <= half;
  const double side = d > 0.0 ? 1.0 : -1.0;
  const double t_in = (-side * half - o) / d;
  const double t_out = (side * half - o) / d;
  if (t_in > chord.t_in) {
    chord.t_in = t_in;
    chord.normal_in = -side * Eigen::Vector3d::Unit(axis);
  }
  if (t_out < chord.t_out) {
    chord.t_out = t_out;
    chord.normal_out = side * Eigen::Vector3d::Unit(axis);
  }
  return chord.t_in <= chord.t_out;
}

RayInterval whole_line() {
  return {-kInfinity, kInfinity, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
}

}  // namespace

bool intersect_triangle(const Ray& ray, const Eigen::Vector3d& v0, const Eigen::Vector3d& v1,
                        const Eigen::Vector3d& v2, TriangleHit& hit) {
  const Eigen::Vector3d a = v0 - ray.origin;
  const Eigen::Vector3d b = v1 - ray.origin;
  const Eigen::Vector3d c = v2 - ray.origin;
  const double w0 = ray.direction.dot(b.cross(c));
  const double w1 = ray.direction.dot(c.cross(a));
  const double w2 = ray.direction.dot(a.cross(b));
  const bool all_positive = w0 >= 0.0 && w1 >= 0.0 && w2 >= 0.0;
  const bool all_negative = w0 <= 0.0 && w1 <= 0.0 && w2 <= 0.0;
  if (!all_positive && !all_negative) return false;
  hit.normal = (v1 - v0).cross(v2 - v0);
  const double slope = hit.normal.dot(ray.direction);
  const double sum = w0 + w1 + w2;
  if (slope == 0.0 || sum == 0.0) return false;
  hit.t = hit.normal.dot(a) / slope;
  hit.weights = Eigen::Vector3d(w0, w1, w2) / sum;
  return hit.t >= 0.0;
}

bool intersect_sphere(const Ray& ray, double radius, RayInterval& chord) {
  // The chord is measured from the point nearest to the centre, so that a far origin costs no
  // digits.
  const double scale = ray.direction.squaredNorm();
  const double t_middle = -ray.origin.dot(ray.direction) / scale;
  const double rest = radius * radius - ray.at(t_middle).squaredNorm();
  if (rest < 0.0) return false;
  const double half = std::sqrt(rest / scale);
  chord.t_in = t_middle - half;
  chord.t_out = t_middle + half;
  chord.normal_in = ray.at(chord.t_in);
  chord.normal_out = ray.at(chord.t_out);
  return true;
}

bool intersect_box(const Ray& ray, const Eigen::Vector3d& half_size, RayInterval& chord) {
  chord = whole_line();
  for (int axis = 0; axis < 3; ++axis) {
    if (!clip_slab(ray, axis, half_size[axis], chord)) return false;
  }
  return true;
}

bool intersect_cylinder(const Ray& ray, double radius, double half_length, RayInterval& chord) {
  chord = whole_line();
  const Eigen::Vector2d o = ray.origin.head<2>();
  const Eigen::Vector2d d = ray.direction.head<2>();
  const double scale = d.squaredNorm();
  if (scale > 0.0) {
    const double t_middle = -o.dot(d) / scale;
    const double rest = radius * radius - (o + t_middle * d).squaredNorm();
    if (rest < 0.0) return false;
    const double half = std::sqrt(rest / scale);
    chord.t_in = t_middle - half;
    chord.t_out = t_middle + half;
    chord.normal_in << o + chord.t_in * d, 0.0;
    chord.normal_out << o + chord.t_out * d, 0.0;
  } else if (o.squaredNorm() > radius * radius) {
    return false;
  }
  return clip_slab(ray, 2, half_length, chord);
}

bool intersect_ground(const Ray& ray, double& t) {
  if (ray.direction.z() == 0.0) return false;
  t = -ray.origin.z() / ray.direction.z();
  return t >= 0.0;
}

}  // namespace ardee::raycast
