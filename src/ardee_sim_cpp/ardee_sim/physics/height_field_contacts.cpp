// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/height_field_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ardee::physics {
namespace {

using Eigen::Vector3d;

constexpr double kSamePoint = 1e-6;  // m: nearer contacts are merged
constexpr double kRimRidge = 1e-4;   // m: least rise of the ground that touches between the rims
constexpr double kPastEnd = 1e-9;    // share of an edge: rounding at its ends
constexpr double kOnEnd =
    0.7;  // |cos| of a cylinder's axis to the vertical, above which it stands on end
constexpr int kRimPoints = 8;

/// The point of a triangle nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
Vector3d closest_point(const FieldTriangle& t, const Vector3d& p) {
  const Vector3d ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return t.a;
  const Vector3d bp = p - t.b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return t.b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return t.a + d1 / (d1 - d3) * ab;
  const Vector3d cp = p - t.c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return t.c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return t.a + d2 / (d2 - d6) * ac;
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return t.b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t.c - t.b);
  }
  const double denominator = 1.0 / (va + vb + vc);
  return t.a + ab * vb * denominator + ac * vc * denominator;
}

/// A circle of a cylinder: centre, unit axis, radius.
struct Circle {
  Vector3d center;
  Vector3d axis;
  double radius_m;
};

/// Depth of the deepest point of a circle found so far.
struct CircleContacts {
  ContactPoints contacts;
  double deepest_m = 0.0;

  void add(const ContactPoint& contact) {
    add_contact(contact, contacts);
    deepest_m = std::max(deepest_m, contact.depth_m);
  }
};

/// The circle's lowest point along -normal.
Vector3d support(const Circle& circle, const Vector3d& normal) {
  const Vector3d in_plane = normal - normal.dot(circle.axis) * circle.axis;
  const double length = in_plane.norm();
  if (length < 1e-9) return circle.center;
  return circle.center - circle.radius_m / length * in_plane;
}

void touch_face(const Circle& circle, const FieldTriangle& triangle, CircleContacts& result) {
  const Vector3d point = support(circle, triangle.normal);
  const double depth_m = triangle.normal.dot(triangle.a - point);
  if (depth_m <= 0.0 || !triangle.covers(point.x(), point.y())) return;
  result.add({point, triangle.normal, depth_m});
}

/// The lower of the points where the circle crosses the vertical plane through an edge; false if it
/// lies outside the edge.
bool cross_edge(const Circle& circle, const Vector3d& start, const Vector3d& end, Vector3d& point) {
  const Vector3d across(end.y() - start.y(), start.x() - end.x(), 0.0);
  const Vector3d down = support(circle, Vector3d::UnitZ()) - circle.center;
  const Vector3d along = circle.axis.cross(down);
  const double a = across.dot(down), b = across.dot(along);
  const double c = across.dot(start - circle.center);
  const double amplitude = std::hypot(a, b);
  if (std::abs(c) >= amplitude) return false;
  const double middle = std::atan2(b, a), half = std::acos(c / amplitude);
  const double first = std::remainder(middle + half, 2.0 * M_PI);
  const double second = std::remainder(middle - half, 2.0 * M_PI);
  const double angle = std::abs(first) < std::abs(second) ? first : second;
  point = circle.center + std::cos(angle) * down + std::sin(angle) * along;
  const Vector3d edge = end - start;
  const double t = (point - start).head<2>().dot(edge.head<2>()) / edge.head<2>().squaredNorm();
  if (t < -kPastEnd || t > 1.0 + kPastEnd) return false;
  point.z() =
      (1.0 - t) * start.z() + t * end.z() - point.z();  // depth below the edge, for the caller
  return true;
}

/// A circle rests on the edge between two faces if its deepest point for each face lies beyond the
/// edge.
void touch_edge(const Circle& circle, const FieldTriangle& left, const FieldTriangle& right,
                const Vector3d& start, const Vector3d& end, CircleContacts& result) {
  const Eigen::Vector2d direction = (end - start).head<2>();
  const auto is_left = [&](const Vector3d& p) {
    return direction.x() * (p.y() - start.y()) - direction.y() * (p.x() - start.x()) > 0.0;
  };
  if (is_left(support(circle, left.normal)) || !is_left(support(circle, right.normal))) return;
  Vector3d point;
  if (!cross_edge(circle, start, end, point) || point.z() <= 0.0) return;
  const double below_m = point.z();
  const Eigen::Vector2d from_start = point.head<2>() - start.head<2>();
  const double t = from_start.dot(direction) / direction.squaredNorm();
  point.z() = (1.0 - t) * start.z() + t * end.z() - below_m;
  const Vector3d radial = (circle.center - point) / circle.radius_m;
  const double sideways = 0.5 * (left.normal + right.normal).dot(circle.axis);
  const Vector3d normal =
      (radial * std::sqrt(std::max(0.0, 1.0 - sideways * sideways)) + sideways * circle.axis)
          .normalized();
  if (normal.z() > 0.0) result.add({point, normal, below_m * normal.z()});
}

void touch_cell(const HeightField& field, const CellRange& range, int column, int row,
                const Circle& circle, CircleContacts& result) {
  const FieldTriangle lower = field.triangle(column, row, 0);
  const FieldTriangle upper = field.triangle(column, row, 1);
  touch_face(circle, lower, result);
  touch_face(circle, upper, result);
  touch_edge(circle, upper, lower, lower.a, lower.c, result);
  if (column < range.last_column) {
    touch_edge(circle, lower, field.triangle(column + 1, row, 1), lower.b, lower.c, result);
  }
  if (row < range.last_row) {
    touch_edge(circle, field.triangle(column, row + 1, 0), upper, upper.c, upper.b, result);
  }
}

CircleContacts touch_circle(const HeightField& field, const Circle& circle) {
  CircleContacts result;
  const Vector3d reach =
      circle.radius_m * (Vector3d::Ones() - circle.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  const Vector3d low = circle.center - reach, high = circle.center + reach;
  const CellRange range = field.cells(low.x(), low.y(), high.x(), high.y());
  if (range.empty() || field.highest(range) < low.z()) return result;
  for (int row = range.first_row; row <= range.last_row; ++row) {
    for (int column = range.first_column; column <= range.last_column; ++column) {
      touch_cell(field, range, column, row, circle, result);
    }
  }
  return result;
}

void collide_on_end(const HeightField& field, const Pose& X_FC, const Cylinder& cylinder,
                    const Vector3d& axis, ContactPoints& contacts) {
  const double end = axis.z() > 0.0 ? -0.5 * cylinder.length_m : 0.5 * cylinder.length_m;
  for (int i = 0; i < kRimPoints; ++i) {
    const double angle = 2.0 * M_PI * i / kRimPoints;
    add_point(field,
              X_FC * Vector3d(cylinder.radius_m * std::cos(angle),
                              cylinder.radius_m * std::sin(angle), end),
              contacts);
  }
  add_point(field, X_FC * Vector3d(0, 0, end), contacts);
}

}  // namespace

void add_contact(const ContactPoint& contact, ContactPoints& contacts) {
  for (const ContactPoint& other : contacts) {
    if ((other.position - contact.position).squaredNorm() < kSamePoint * kSamePoint) return;
  }
  contacts.push_back(contact);
}

double depth_below(const HeightField& field, const Vector3d& point, Vector3d& normal) {
  const auto triangle = field.triangle_at(point.x(), point.y());
  if (!triangle) return -std::numeric_limits<double>::infinity();
  normal = triangle->normal;
  return triangle->height(point.x(), point.y()) - point.z();
}

void add_point(const HeightField& field, const Vector3d& point, ContactPoints& contacts) {
  Vector3d normal;
  const double below_m = depth_below(field, point, normal);
  if (below_m > 0.0) add_contact({point, normal, below_m * normal.z()}, contacts);
}

void collide_sphere(const HeightField& field, const Vector3d& center, double radius_m,
                    ContactPoints& contacts) {
  const auto under = field.triangle_at(center.x(), center.y());
  if (under && under->height(center.x(), center.y()) >= center.z()) {
    const double below_m = under->normal.dot(under->a - center);
    add_contact({center, under->normal, radius_m + below_m}, contacts);
    return;
  }
  const CellRange range = field.cells(center.x() - radius_m, center.y() - radius_m,
                                      center.x() + radius_m, center.y() + radius_m);
  if (range.empty() || field.highest(range) < center.z() - radius_m) return;
  std::vector<std::pair<FieldTriangle, Vector3d>> touched;
  for (int row = range.first_row; row <= range.last_row; ++row) {
    for (int column = range.first_column; column <= range.last_column; ++column) {
      for (int half = 0; half < 2; ++half) {
        const FieldTriangle triangle = field.triangle(column, row, half);
        const Vector3d point = closest_point(triangle, center);
        if ((point - center).squaredNorm() < radius_m * radius_m)
          touched.emplace_back(triangle, point);
      }
    }
  }
  for (const auto& touch : touched) {
    const Vector3d& point = touch.second;
    // If the other face of the edge is nearer, the point is not the nearest point of the ground.
    const double distance = (point - center).norm();
    const bool nearest = std::none_of(touched.begin(), touched.end(), [&](const auto& other) {
      return (other.second - center).norm() < distance - 1e-9 &&
             (closest_point(other.first, point) - point).norm() < kSamePoint;
    });
    if (!nearest || distance < 1e-9) continue;
    add_contact({point, (center - point) / distance, radius_m - distance}, contacts);
  }
}

void collide_cylinder(const HeightField& field, const Pose& X_FC, const Cylinder& cylinder,
                      ContactPoints& contacts) {
  const Vector3d axis = X_FC.q * Vector3d::UnitZ();
  if (std::abs(axis.z()) > kOnEnd) {
    collide_on_end(field, X_FC, cylinder, axis, contacts);
    return;
  }
  const Vector3d half = 0.5 * cylinder.length_m * axis;
  const CircleContacts left = touch_circle(field, {X_FC.p - half, axis, cylinder.radius_m});
  const CircleContacts middle = touch_circle(field, {X_FC.p, axis, cylinder.radius_m});
  const CircleContacts right = touch_circle(field, {X_FC.p + half, axis, cylinder.radius_m});
  for (const auto* circle : {&left, &right}) {
    for (const ContactPoint& contact : circle->contacts) add_contact(contact, contacts);
  }
  const auto ends = static_cast<double>(contacts.size());
  for (const ContactPoint& contact : middle.contacts) add_contact(contact, contacts);
  const bool is_ridge = middle.deepest_m > 0.5 * (left.deepest_m + right.deepest_m) + kRimRidge;
  if (is_ridge || ends == 0.0) return;
  for (ContactPoint& contact : contacts) {
    contact.share = ends / static_cast<double>(contacts.size());
  }
}

void collide_vertices(const HeightField& field, const Pose& X_FV, double scale,
                      const VertexTree& vertices, ContactPoints& contacts) {
  const Eigen::Matrix3d turn = X_FV.q.toRotationMatrix();
  const Eigen::Matrix3d spread = turn.cwiseAbs();
  const auto may_touch = [&](const Eigen::AlignedBox3f& box) {
    const Vector3d center = scale * (turn * box.center().cast<double>()) + X_FV.p;
    const Vector3d reach = 0.5 * scale * (spread * box.sizes().cast<double>());
    const Vector3d low = center - reach, high = center + reach;
    if (low.z() >= field.bounds().max().z()) return false;
    const CellRange range = field.cells(low.x(), low.y(), high.x(), high.y());
    return !range.empty() && low.z() < field.highest(range);
  };
  vertices.visit(may_touch, [&](const Eigen::Vector3f& vertex) {
    const Vector3d point = scale * (turn * vertex.cast<double>()) + X_FV.p;
    Vector3d normal;
    const double below_m = depth_below(field, point, normal);
    if (below_m > 0.0) contacts.push_back({point, normal, below_m * normal.z()});
  });
}

void reduce_contacts(ContactPoints& contacts, std::size_t max_contacts) {
  if (contacts.size() <= max_contacts) return;
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const auto& a, const auto& b) { return a.depth_m > b.depth_m; });
  for (std::size_t kept = 1; kept < max_contacts; ++kept) {
    std::size_t farthest = kept;
    double farthest_m2 = -1.0;
    for (std::size_t i = kept; i < contacts.size(); ++i) {
      double nearest_m2 = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j < kept; ++j) {
        nearest_m2 =
            std::min(nearest_m2, (contacts[i].position - contacts[j].position).squaredNorm());
      }
      if (nearest_m2 > farthest_m2) {
        farthest_m2 = nearest_m2;
        farthest = i;
      }
    }
    std::swap(contacts[kept], contacts[farthest]);
  }
  contacts.resize(max_contacts);
}

}  // namespace ardee::physics
