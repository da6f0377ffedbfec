// SPDX-License-Identifier: MIT
#include "ardee_sim/description/collision_bodies.h"

#include <algorithm>

namespace ardee {
namespace {

constexpr double kGrowth_m = 0.0005;  // on each side
constexpr double kTransparency = 0.5;
const Color kOrange{1.0f, 0.5f, 0.1f, 1.0f};

/// Grows a body; one overload per kind of geometry.
struct Grow {
  void operator()(Box& box) const { box.size_m.array() += 2.0 * kGrowth_m; }
  void operator()(Sphere& sphere) const { sphere.radius_m += kGrowth_m; }
  void operator()(Cylinder& cylinder) const {
    cylinder.radius_m += kGrowth_m;
    cylinder.length_m += 2.0 * kGrowth_m;
  }
  template <typename Other>
  void operator()(Other& /*other*/) const {}
};

bool is_ground(const Geometry& geometry) {
  return std::holds_alternative<Plane>(geometry) || std::holds_alternative<Heightmap>(geometry);
}

bool is_shown_already(const Link& link, const Geometry& geometry) {
  const Mesh* body = std::get_if<Mesh>(&geometry);
  return body != nullptr &&
         std::any_of(link.visuals.begin(), link.visuals.end(), [&](const Visual& visual) {
           const Mesh* mesh = std::get_if<Mesh>(&visual.geometry);
           return mesh != nullptr && mesh->file == body->file;
         });
}

Visual visual_of(const Collision& collision) {
  Visual visual;
  visual.name = collision.name;
  visual.X_LV = collision.X_LC;
  visual.geometry = collision.geometry;
  std::visit(Grow(), visual.geometry);
  visual.material.emplace();
  visual.material->ambient = kOrange;
  visual.material->diffuse = kOrange;
  visual.transparency = kTransparency;
  visual.cast_shadows = false;
  return visual;
}

}  // namespace

std::shared_ptr<const Model> collision_bodies(const Model& model) {
  auto bodies = std::make_shared<Model>();
  bodies->name = model.name;
  bodies->source = model.source;
  for (const Link& link : model.links) {
    Link shown;
    shown.name = link.name;
    shown.X_ML = link.X_ML;
    for (const Collision& collision : link.collisions) {
      if (is_ground(collision.geometry) || is_shown_already(link, collision.geometry)) continue;
      shown.visuals.push_back(visual_of(collision));
    }
    if (!shown.visuals.empty()) bodies->links.push_back(std::move(shown));
  }
  return bodies;
}

}  // namespace ardee
