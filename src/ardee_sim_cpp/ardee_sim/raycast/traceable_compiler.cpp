// SPDX-License-Identifier: MIT
#include "ardee_sim/raycast/traceable_compiler.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>
#include <variant>

#include "ardee_sim/description/shape_fault.h"
#include "ardee_sim/raycast/clustering.h"
#include "ardee_sim/raycast/ray_query.h"

namespace ardee::raycast {
namespace {

/// Number of primitives below which a loop over them is quicker than a tree.
constexpr std::size_t kTreeThreshold = 3;
/// Least transparency of visuals that cast no shadow.
constexpr double kThin = 0.5;

/// Returns the share of light that a surface sends back: its laser_retro, else the brightest
/// channel of its diffuse colour. Lidars use near infrared light, which plants reflect at least as
/// well as any colour.
float reflectivity(float laser_retro, const Material* material) {
  if (laser_retro > 0.0f) return laser_retro;
  const Color diffuse = material != nullptr ? material->diffuse : Material().diffuse;
  return diffuse.head<3>().maxCoeff();
}

/// Bodies of a description, with what they refer to.
struct Compiled {
  std::shared_ptr<const Model> model;
  std::vector<std::shared_ptr<const AlphaMask>> masks;
  std::vector<std::string> warnings;
  TraceableBodies bodies;
};

/// Collects the shapes of links into a body of `compiled`.
class BodyCompiler {
 public:
  BodyCompiler(AlphaMasks& masks, Compiled& compiled, SceneKind kind)
      : masks_(masks), compiled_(compiled), model_(*compiled.model), kind_(kind) {}

  void add_link(std::uint32_t link, const Pose& X_BL) {
    const Link& description = model_.links[link];
    surface_ = TraceableSurface{};
    surface_.link = link;
    if (kind_ == SceneKind::kCollision) {
      for (std::size_t k = 0; k < description.collisions.size(); ++k) {
        const Collision& shape = description.collisions[k];
        add_shape(shape.name, k, X_BL * shape.X_LC, shape.laser_retro, nullptr, shape.geometry);
      }
      return;
    }
    for (std::size_t k = 0; k < description.visuals.size(); ++k) {
      const Visual& shape = description.visuals[k];
      const Material* material = shape.material ? &*shape.material : nullptr;
      surface_.visual = &shape;
      surface_.casts_shadows = shape.cast_shadows && shape.transparency < kThin;
      add_shape(shape.name, k, X_BL * shape.X_LV, shape.laser_retro, material, shape.geometry);
    }
  }

  void finish();

 private:
  void add_shape(const std::string& name, std::size_t index, const Pose& X_BS, double laser_retro,
                 const Material* material, const Geometry& geometry) {
    shape_name_ = &name;
    surface_.shape = static_cast<std::uint32_t>(index);
    surface_.laser_retro = static_cast<float>(laser_retro);
    surface_.two_sided = sides(material);
    material_ = material;
    surface_.material = material;
    next_primitive_ = 0;
    if (!X_BS.is_finite()) throw error("its pose is not finite");
    if (const auto fault = find_fault(geometry)) throw error(fault->message());
    X_BS_ = X_BS;
    std::visit([this](const auto& shape) { add(shape); }, geometry);
  }

  bool sides(const Material* material) const {
    return kind_ == SceneKind::kCollision || (material != nullptr && material->two_sided);
  }

  /// Returns nullptr for a surface without holes.
  std::shared_ptr<const AlphaMask> holes(const Material* material, const SubMesh& part) const {
    const bool wanted = kind_ == SceneKind::kVisual && material != nullptr &&
                        material->alpha_rejection >= 0.0f && !material->texture_path.empty() &&
                        part.texcoords.size() == part.vertices.size();
    if (!wanted) return nullptr;
    try {
      compiled_.masks.push_back(masks_.get(material->texture_path, material->alpha_rejection));
      return compiled_.masks.back()->has_holes() ? compiled_.masks.back() : nullptr;
    } catch (const Error& error) {
      compiled_.warnings.push_back(std::string(error.what()) + "; rays take the texture as opaque");
      return nullptr;
    }
  }

  Error error(const std::string& what) const {
    return Error(model_.source, "model '" + model_.name + "', link '" +
                                    model_.links[surface_.link].name + "', shape '" + *shape_name_ +
                                    "': " + what);
  }

  std::uint32_t add_surface() {
    surface_.reflectivity = reflectivity(surface_.laser_retro, surface_.material);
    body_->surfaces.push_back(surface_);
    return static_cast<std::uint32_t>(body_->surfaces.size() - 1);
  }

  void add_solid(AnalyticSolid::Kind kind, const Eigen::Vector3d& half_m) {
    AnalyticSolid solid;
    solid.kind = kind;
    solid.R_BS = X_BS_.q.toRotationMatrix();
    solid.p_BS = X_BS_.p;
    solid.half_m = half_m;
    solid.surface = add_surface();
    const auto index = static_cast<std::uint32_t>(body_->solids.size());
    body_->solids.push_back(solid);
    if (kind == AnalyticSolid::Kind::kGround) {
      body_->grounds.push_back(index);
      return;
    }
    Bounds box;
    box.add(half_m);
    box.add(-half_m);
    add_piece({Primitive::Kind::kSolid, index}, box.transformed(solid.R_BS, solid.p_BS));
  }

  void add(const Box& box) { add_solid(AnalyticSolid::Kind::kBox, 0.5 * box.size_m); }
  void add(const Sphere& sphere) {
    add_solid(AnalyticSolid::Kind::kSphere, Eigen::Vector3d::Constant(sphere.radius_m));
  }
  void add(const Cylinder& cylinder) {
    add_solid(AnalyticSolid::Kind::kCylinder,
              {cylinder.radius_m, cylinder.radius_m, 0.5 * cylinder.length_m});
  }

  void add(const Plane& plane) {
    X_BS_.q = X_BS_.q * Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), plane.normal);
    const bool infinite = kind_ == SceneKind::kCollision;
    add_solid(infinite ? AnalyticSolid::Kind::kGround : AnalyticSolid::Kind::kRectangle,
              {0.5 * plane.size_m.x(), 0.5 * plane.size_m.y(), 0.0});
  }

  void add(const Heightmap& map) {
    const auto terrain = static_cast<std::uint32_t>(body_->terrains.size());
    body_->terrains.push_back({HeightSurface(map.grid), X_BS_.q.toRotationMatrix(),
                               X_BS_ * map.position_m, add_surface()});
    const Terrain& made = body_->terrains.back();
    for (const HeightPatch& patch : made.heights.patches()) {
      const auto index = static_cast<std::uint32_t>(body_->patches.size());
      body_->patches.push_back({terrain, patch});
      const Bounds box = made.heights.bounds(patch);
      add_piece({Primitive::Kind::kPatch, index}, box.transformed(made.R_BS, made.p_BS));
    }
  }

  void add(const Mesh& mesh);
  void add_part(const SubMesh& part, const Mesh& mesh, const Eigen::Vector3d& center);
  void add_piece(const Primitive& primitive, const Bounds& bounds) {
    body_->primitives.push_back(primitive);
    body_->primitive_bounds.push_back(bounds);
  }
  void make_blocks();
  void fill_block(TriangleBlock& block, const Bounds& bounds);

  AlphaMasks& masks_;
  Compiled& compiled_;
  const Model& model_;
  SceneKind kind_;
  std::unique_ptr<Traceable> body_ = std::make_unique<Traceable>();
  const std::string* shape_name_ = nullptr;
  const Material* material_ = nullptr;
  TraceableSurface surface_;
  Pose X_BS_;
  std::uint32_t next_primitive_ = 0;
};

void BodyCompiler::add(const Mesh& mesh) {
  std::vector<const SubMesh*> parts;
  for (const SubMesh& part : mesh.file->parts) {
    if (mesh.submesh.empty() || part.name == mesh.submesh) parts.push_back(&part);
  }
  if (parts.empty() && !mesh.submesh.empty()) {
    throw error("mesh '" + mesh.uri + "' has no submesh '" + mesh.submesh + "'");
  }
  Bounds all;
  for (const SubMesh* part : parts) {
    for (const Eigen::Vector3f& vertex : part->vertices) all.add(vertex.cast<double>());
  }
  const bool centered = mesh.center && !all.empty();
  const Eigen::Vector3d center = centered ? all.center() : Eigen::Vector3d::Zero();
  for (const SubMesh* part : parts) add_part(*part, mesh, center);
}

void BodyCompiler::add_part(const SubMesh& part, const Mesh& mesh, const Eigen::Vector3d& center) {
  const bool known =
      part.material >= 0 && static_cast<std::size_t>(part.material) < mesh.file->materials.size();
  const Material* own =
      known ? &mesh.file->materials[static_cast<std::size_t>(part.material)] : nullptr;
  const Material* material = material_ != nullptr ? material_ : own;
  surface_.two_sided = sides(material);
  surface_.mask = holes(material, part);
  surface_.material = material;
  surface_.part = &part;
  const auto base = static_cast<std::uint32_t>(body_->vertices.size());
  surface_.first_vertex = base;
  surface_.normals_to_body = X_BS_.q.toRotationMatrix() * mesh.scale.cwiseInverse().asDiagonal();
  if (surface_.mask != nullptr) {
    body_->texcoords.resize(base);
    body_->texcoords.insert(body_->texcoords.end(), part.texcoords.begin(), part.texcoords.end());
  }
  const std::uint32_t surface = add_surface();
  surface_.mask.reset();
  surface_.part = nullptr;
  for (const Eigen::Vector3f& vertex : part.vertices) {
    const Eigen::Vector3d scaled = mesh.scale.cwiseProduct(vertex.cast<double>() - center);
    const Eigen::Vector3f placed = (X_BS_ * scaled).cast<float>();
    if (!placed.allFinite()) throw error("mesh '" + mesh.uri + "' has a vertex that is not finite");
    body_->vertices.push_back(placed);
  }
  // A mirrored mesh keeps its outside, as in OGRE, which flips the culling for a negative scale.
  const bool mirrored = mesh.scale.prod() < 0.0;
  for (const auto& corners : part.triangles) {
    TraceableTriangle triangle{corners, surface, next_primitive_++};
    if (mirrored) std::swap(triangle.vertices[1], triangle.vertices[2]);
    for (std::uint32_t& vertex : triangle.vertices) {
      if (vertex >= part.vertices.size()) {
        throw error("mesh '" + mesh.uri + "' has a triangle with vertex " + std::to_string(vertex) +
                    " of " + std::to_string(part.vertices.size()));
      }
      vertex += base;
    }
    body_->triangles.push_back(triangle);
  }
}

void BodyCompiler::make_blocks() {
  std::vector<Bounds> boxes(body_->triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const std::uint32_t vertex : body_->triangles[i].vertices) {
      boxes[i].add(body_->vertices[vertex].cast<double>());
    }
  }
  std::vector<std::uint32_t> order;
  const std::vector<std::uint32_t> starts = group_boxes(boxes, kBlockLanes, order);
  std::vector<TraceableTriangle> sorted(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = body_->triangles[order[i]];
  body_->triangles = std::move(sorted);
  for (std::size_t k = 0; k + 1 < starts.size(); ++k) {
    TriangleBlock block{};
    block.first = starts[k];
    block.count = starts[k + 1] - starts[k];
    Bounds bounds;
    for (std::uint32_t i = starts[k]; i < starts[k + 1]; ++i) bounds.add(boxes[order[i]]);
    fill_block(block, bounds);
    add_piece({Primitive::Kind::kBlock, static_cast<std::uint32_t>(body_->blocks.size())}, bounds);
    body_->blocks.push_back(block);
  }
}

void BodyCompiler::fill_block(TriangleBlock& block, const Bounds& bounds) {
  block.center = bounds.center();
  block.radius = static_cast<float>(1.0001 * bounds.radius());
  for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
    const std::uint32_t index = block.first + std::min(lane, block.count - 1);
    const TraceableTriangle& triangle = body_->triangles[index];
    const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
      return body_->vertices[triangle.vertices[k]].cast<double>() - block.center;
    };
    const Eigen::Vector3d v0 = corner(0);
    const Eigen::Vector3d edge1 = corner(1) - v0;
    const Eigen::Vector3d edge2 = corner(2) - v0;
    for (int k = 0; k < 3; ++k) {
      block.vertex[k][lane] = static_cast<float>(v0[k]);
      block.edge1[k][lane] = static_cast<float>(edge1[k]);
      block.edge2[k][lane] = static_cast<float>(edge2[k]);
    }
    const double longest = std::max({edge1.norm(), edge2.norm(), (edge1 - edge2).norm()});
    block.longest = std::max(block.longest, static_cast<float>(1.0001 * longest));
  }
}

void BodyCompiler::finish() {
  make_blocks();
  Traceable& body = *body_;
  for (const Bounds& box : body.primitive_bounds) body.bounds.add(box);
  if (body.primitives.size() >= kTreeThreshold) {
    const double extent = body.bounds.center().norm() + body.bounds.radius();
    body.scene = std::make_unique<EmbreeScene>(
        body.primitives.size(),
        [&](std::size_t primitive, float* lower, float* upper) {
          round_outwards(body.primitive_bounds[primitive], extent, lower, upper);
        },
        &intersect_primitive_of, &body, BuildQuality::kMedium);
  }
  compiled_.bodies.push_back(std::move(body_));
}

enum class Unit { kModel, kLink };

std::shared_ptr<const Compiled> compile(const std::shared_ptr<const Model>& model, SceneKind kind,
                                        Unit unit) {
  static AlphaMasks masks;
  auto compiled = std::make_shared<Compiled>();
  compiled->model = model;
  const auto links = static_cast<std::uint32_t>(model->links.size());
  if (unit == Unit::kModel) {
    BodyCompiler compiler(masks, *compiled, kind);
    for (std::uint32_t k = 0; k < links; ++k) compiler.add_link(k, model->links[k].X_ML);
    compiler.finish();
    return compiled;
  }
  for (std::uint32_t k = 0; k < links; ++k) {
    BodyCompiler compiler(masks, *compiled, kind);
    compiler.add_link(k, Pose{});
    compiler.finish();
  }
  return compiled;
}

/// Returns the bodies of a description that a scene of this process has already, else compiles it.
std::shared_ptr<const Compiled> find_or_compile(const std::shared_ptr<const Model>& model,
                                                SceneKind kind, Unit unit, Log& log) {
  static std::mutex mutex;
  static std::map<std::tuple<const Model*, SceneKind, Unit>, std::weak_ptr<const Compiled>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  std::weak_ptr<const Compiled>& entry = known[{model.get(), kind, unit}];
  std::shared_ptr<const Compiled> compiled = entry.lock();
  if (compiled == nullptr) {
    entry = compiled = compile(model, kind, unit);
    for (auto each = known.begin(); each != known.end();) {
      each = each->second.expired() ? known.erase(each) : std::next(each);
    }
  }
  for (const std::string& warning : compiled->warnings) log.warn_once(warning);
  return compiled;
}

}  // namespace

std::shared_ptr<const Traceable> compile_model(const std::shared_ptr<const Model>& model,
                                               SceneKind kind, Log& log) {
  const auto compiled = find_or_compile(model, kind, Unit::kModel, log);
  return {compiled, compiled->bodies.front().get()};
}

std::shared_ptr<const TraceableBodies> compile_links(const std::shared_ptr<const Model>& model,
                                                     SceneKind kind, Log& log) {
  const auto compiled = find_or_compile(model, kind, Unit::kLink, log);
  return {compiled, &compiled->bodies};
}

}  // namespace ardee::raycast
