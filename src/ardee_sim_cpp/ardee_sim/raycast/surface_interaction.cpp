// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/surface_interaction.h"

#include <cmath>

#include "ardee_sim/raycast/ray_query.h"

namespace ardee::raycast {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Maps the picture onto each face of a box, upright on its sides.
void map_box(const Eigen::Vector3d& p, const Eigen::Vector3d& half, SurfaceInteraction& point) {
  int axis = 0;
  p.cwiseAbs().cwiseQuotient(half.cwiseMax(1e-9)).maxCoeff(&axis);
  const int u = axis == 0 ? 1 : 0;
  const int v = axis == 2 ? 1 : 2;
  const Eigen::Vector2d size(2.0 * half[u], 2.0 * half[v]);
  point.uv = {p[u] / size.x() + 0.5, p[v] / size.y() + 0.5};
  point.uv_per_m = 1.0 / std::sqrt(size.prod());
}

/// Maps the picture once round a cylinder, and once on each of its ends.
void map_cylinder(const Eigen::Vector3d& p, double radius, double half_length,
                  SurfaceInteraction& point) {
  if (std::abs(p.z()) >= half_length * (1.0 - 1e-9)) {
    point.uv = p.head<2>() / (2.0 * radius) + Eigen::Vector2d(0.5, 0.5);
    point.uv_per_m = 0.5 / radius;
    return;
  }
  point.uv = {std::atan2(p.y(), p.x()) / (2.0 * kPi) + 0.5, 0.5 * p.z() / half_length + 0.5};
  point.uv_per_m = 1.0 / std::sqrt(4.0 * kPi * radius * half_length);
}

/// Maps the picture once round a sphere, by longitude and latitude.
void map_sphere(const Eigen::Vector3d& p, double radius, SurfaceInteraction& point) {
  const double sine = std::min(1.0, std::max(-1.0, p.z() / radius));
  point.uv = {std::atan2(p.y(), p.x()) / (2.0 * kPi) + 0.5, std::asin(sine) / kPi + 0.5};
  point.uv_per_m = 1.0 / (std::sqrt(2.0) * kPi * radius);
}

}  // namespace

void RayQuery::fill_triangle(SurfaceInteraction& point) const {
  const Traceable& body = *placed_->body;
  const TraceableTriangle& triangle = body.triangles[item_];
  const TraceableSurface& surface = body.surfaces[surface_];
  const SubMesh& part = *surface.part;
  const Ray ray_B = placed_->to_body(ray_W_);
  Eigen::Vector3d corners[3];
  std::size_t own[3];
  for (std::size_t k = 0; k < 3; ++k) {
    corners[k] = body.vertices[triangle.vertices[k]].cast<double>();
    own[k] = triangle.vertices[k] - surface.first_vertex;
  }
  TriangleHit hit;
  if (!intersect_triangle(ray_B, corners[0], corners[1], corners[2], hit)) return;
  point.point_S = ray_B.at(hit.t);
  if (part.texcoords.size() == part.vertices.size()) {
    Eigen::Vector2d uv[3];
    point.uv.setZero();
    for (int k = 0; k < 3; ++k) {
      uv[k] = part.texcoords[own[k]].cast<double>();
      point.uv += hit.weights[k] * uv[k];
    }
    const Eigen::Vector2d a = uv[1] - uv[0];
    const Eigen::Vector2d b = uv[2] - uv[0];
    const double area = hit.normal.norm() * placed_->scale * placed_->scale;
    point.uv_per_m = std::max(std::sqrt(std::abs(a.x() * b.y() - a.y() * b.x()) / area), 1e-12);
  }
  if (part.normals.size() != part.vertices.size()) return;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d each = surface.normals_to_body * part.normals[own[k]].cast<double>();
    const double length = each.norm();
    if (!(length > 0.0) || !std::isfinite(length)) return;
    normal += hit.weights[k] * each / length;
  }
  if (normal.norm() > 1e-3) point.smooth_normal_W = (placed_->q * normal).normalized();
}

void RayQuery::fill_solid(SurfaceInteraction& point) const {
  const AnalyticSolid& solid = placed_->body->solids[item_];
  const Ray ray_B = placed_->to_body(ray_W_);
  const Eigen::Vector3d p = solid.R_BS.transpose() * (ray_B.at(best_t_) - solid.p_BS);
  point.point_S = p;
  switch (solid.kind) {
    case AnalyticSolid::Kind::kSphere:
      map_sphere(p, solid.half_m.x(), point);
      break;
    case AnalyticSolid::Kind::kCylinder:
      map_cylinder(p, solid.half_m.x(), solid.half_m.z(), point);
      break;
    case AnalyticSolid::Kind::kBox:
      map_box(p, solid.half_m, point);
      break;
    case AnalyticSolid::Kind::kRectangle:
    case AnalyticSolid::Kind::kGround:
      map_box({p.x(), p.y(), 1.0}, {solid.half_m.x(), solid.half_m.y(), 0.0}, point);
      break;
  }
  point.uv_per_m /= placed_->scale;
  if (!point.uv.allFinite() || !std::isfinite(point.uv_per_m)) {
    point.uv.setZero();
    point.uv_per_m = 0.0;
  }
}

void RayQuery::fill_terrain(SurfaceInteraction& point) const {
  const Terrain& terrain = placed_->body->terrains[item_];
  const Ray ray_B = placed_->to_body(ray_W_);
  point.point_S = terrain.R_BS.transpose() * (ray_B.at(best_t_) - terrain.p_BS);
  point.smooth_normal_W =
      placed_->q * (terrain.R_BS * terrain.heights.smooth_normal(point.point_S.head<2>()));
}

void RayQuery::fill(SurfaceInteraction& point) const {
  point = SurfaceInteraction{};
  if (placed_ == nullptr) return;
  const TraceableSurface& surface = placed_->body->surfaces[surface_];
  point.range_m = best_t_;
  point.entity = placed_->entity;
  point.link = surface.link;
  point.shape = surface.shape;
  point.label = placed_->label;
  point.visual = surface.visual;
  point.material = surface.material;
  point.two_sided = surface.two_sided;
  point.normal_W = (placed_->q * normal_B_).normalized();
  if (point.normal_W.dot(ray_W_.direction) > 0.0) point.normal_W = -point.normal_W;
  if (surface.part != nullptr) {
    fill_triangle(point);
  } else if (surface.visual != nullptr &&
             std::holds_alternative<Heightmap>(surface.visual->geometry)) {
    fill_terrain(point);
  } else if (surface.visual != nullptr) {
    fill_solid(point);
  }
  if (point.smooth_normal_W.isZero()) point.smooth_normal_W = point.normal_W;
  if (point.smooth_normal_W.dot(point.normal_W) < 0.0) {
    point.smooth_normal_W = -point.smooth_normal_W;
  }
}

}  // namespace ardee::raycast
