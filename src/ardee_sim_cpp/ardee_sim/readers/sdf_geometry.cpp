// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/sdf_geometry.h"

#include <algorithm>

#include "ardee_sim/readers/mesh_reader.h"

namespace ardee {
namespace {

double positive(const Node& shape, const char* name) {
  const Node size = shape.required(name);
  const double value = size.to_number();
  if (!(value > 0.0)) throw size.error("found '" + size.text() + "', expected a positive number");
  return value;
}

Box read_box(const Node& shape) {
  const Node size = shape.required("size");
  Box box{size.to_vector3()};
  if (!(box.size_m.minCoeff() > 0.0)) {
    throw size.error("found '" + size.text() + "', expected three positive numbers");
  }
  return box;
}

/// A colliding plane is infinite, for any size.
Plane read_plane(const Node& shape, bool collides, Log& log) {
  Plane plane;
  plane.normal = shape.vector3("normal", plane.normal);
  if (!(plane.normal.norm() > 1e-9)) {
    throw shape.error("found a normal of length zero, expected a direction");
  }
  plane.normal.normalize();
  if (const auto size = shape.child("size")) {
    const Eigen::Vector2d size_m = size->to_vector2();
    if (size_m.minCoeff() > 0.0) {
      plane.size_m = size_m;
    } else if (collides) {
      log.warn(size->source(), "found '" + size->text() +
                                   "', expected two positive numbers; sensors see 1 m x 1 m of it");
    } else {
      throw size->error("found '" + size->text() + "', expected two positive numbers");
    }
  }
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
  if (!(size_m.head<2>().minCoeff() > 0.0)) {
    throw shape.required("size").error("found '" + shape.text("size", "") +
                                       "', expected positive x and y");
  }
  map.uri = uri.required_text();
  map.grid = assets.heights(map.uri, size_m, uri.source());
  map.position_m = shape.vector3("pos", Eigen::Vector3d::Zero());
  shape.each("texture", [&](const Node& texture) {
    GroundTexture made;
    made.size_m = texture.child("size") ? positive(texture, "size") : made.size_m;
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
  if (!(scale.cwiseAbs().minCoeff() > 0.0)) {
    throw Error(source, "found a mesh scale of zero, expected another number");
  }
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
                        part_names(*mesh.file));
  }
  return mesh;
}

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
  const std::string_view name = shape->name();
  if (name == "box") return read_box(*shape);
  if (name == "sphere") return Sphere{positive(*shape, "radius")};
  if (name == "cylinder") {
    return Cylinder{positive(*shape, "radius"), positive(*shape, "length")};
  }
  if (name == "plane") return read_plane(*shape, owner.name() == "collision", assets.log());
  std::optional<Geometry> made;
  if (name == "mesh") assets.has_files([&] { made = read_mesh(*shape, assets); });
  if (name == "heightmap") assets.has_files([&] { made = read_heightmap(*shape, assets); });
  return made;
}

}  // namespace ardee
