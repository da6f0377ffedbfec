// SPDX-License-Identifier: MIT
#include <algorithm>

#include "ardee_sim/core/nearest_names.h"
#include "ardee_sim/description/shape_fault.h"
#include "ardee_sim/readers/mesh_reader.h"
#include "ardee_sim/readers/sdf_parts.h"

namespace ardee {
namespace {

/// Throws Error at the element that makes the shape meaningless.
void check(const Node& shape, const Geometry& made) {
  const auto fault = find_fault(made);
  if (!fault) return;
  const Node place = shape.child(fault->field).value_or(shape);
  throw place.error("found '" + place.text() + "', expected " + fault->expected);
}

double number(const Node& shape, const char* name) { return shape.required(name).to_number(); }

/// A colliding plane is infinite, for any size.
Plane read_plane(const Node& shape, bool collides, Log& log) {
  Plane plane;
  plane.normal = shape.vector3("normal", plane.normal);
  if (const auto size = shape.child("size")) {
    const Eigen::Vector2d size_m = size->to_vector2();
    if (!collides || size_m.minCoeff() > 0.0) {
      plane.size_m = size_m;
    } else {
      log.warn(size->source(), "found '" + size->text() +
                                   "', expected two positive numbers; sensors see 1 m x 1 m of it");
    }
  }
  check(shape, plane);
  plane.normal.normalize();
  return plane;
}

Mesh read_mesh(const Node& shape, Assets& assets) {
  const auto old_name = shape.child("filename");  // SDF 1.2
  const Node uri = old_name ? *old_name : shape.required("uri");
  const auto submesh = shape.child("submesh");
  return make_mesh(uri.required_text(), submesh ? submesh->required("name").required_text() : "",
                   shape.boolean("submesh/center", false),
                   shape.vector3("scale", Eigen::Vector3d::Ones()), uri.source(), assets);
}

Heightmap read_heightmap(const Node& shape, Assets& assets) {
  Heightmap map;
  const Node uri = shape.required("uri");
  const Eigen::Vector3d size_m = shape.vector3("size", Eigen::Vector3d::Ones());
  map.uri = uri.required_text();
  map.grid = assets.heights(map.uri, size_m, uri.source());
  map.position_m = shape.vector3("pos", Eigen::Vector3d::Zero());
  shape.each("texture", [&](const Node& texture) {
    GroundTexture made;
    if (const auto size = texture.child("size")) {
      made.size_m = size->to_number();
      if (!(made.size_m > 0.0)) {
        throw size->error("found '" + size->text() + "', expected a positive number");
      }
    }
    if (const auto diffuse = texture.child("diffuse")) {
      made.diffuse_path = assets.texture(diffuse->required_text(), diffuse->source());
    }
    map.textures.push_back(made);
  });
  shape.each("blend", [&map](const Node& blend) {
    map.blends.push_back({blend.number("min_height", 0.0), blend.number("fade_dist", 0.0, 0.0)});
  });
  return map;
}

}  // namespace

Mesh make_mesh(const std::string& uri, const std::string& submesh, bool center,
               const Eigen::Vector3d& scale, const Source& source, Assets& assets) {
  Mesh mesh;
  mesh.file = assets.mesh(uri, source);
  mesh.uri = uri;
  mesh.submesh = submesh;
  mesh.center = center;
  mesh.scale = scale;
  const auto& parts = mesh.file->parts;
  if (!submesh.empty() && std::none_of(parts.begin(), parts.end(),
                                       [&](const SubMesh& part) { return part.name == submesh; })) {
    throw FileError(source, uri + " " + submesh,
                    "found no submesh '" + submesh + "' in '" + uri + "', expected one of " +
                        nearest_names(submesh, part_names(*mesh.file)));
  }
  return mesh;
}

namespace {

std::optional<Geometry> read_shape(const Node& shape, bool collides, Assets& assets) {
  const std::string_view name = shape.name();
  if (name == "box") return Box{shape.required("size").to_vector3()};
  if (name == "sphere") return Sphere{number(shape, "radius")};
  if (name == "cylinder") return Cylinder{number(shape, "radius"), number(shape, "length")};
  if (name == "plane") return read_plane(shape, collides, assets.log());
  std::optional<Geometry> made;
  if (name == "mesh") assets.has_files([&] { made = read_mesh(shape, assets); });
  if (name == "heightmap") assets.has_files([&] { made = read_heightmap(shape, assets); });
  return made;
}

}  // namespace

std::optional<Geometry> read_sdf_geometry(const Node& owner, Assets& assets) {
  std::optional<Node> shape;
  if (const auto geometry = owner.child("geometry")) {
    geometry->each([&](const Node& each) {
      if (!shape) shape = each;
    });
  }
  if (!shape) {
    assets.log().warn(owner.source(), "found no shape in it, expected a <geometry>; left out");
    return std::nullopt;
  }
  auto made = read_shape(*shape, owner.name() == "collision", assets);
  if (made) check(*shape, *made);
  return made;
}

}  // namespace ardee
