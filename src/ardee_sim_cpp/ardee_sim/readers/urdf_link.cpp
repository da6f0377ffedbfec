// SPDX-License-Identifier: MIT
#include <cmath>

#include "ardee_sim/description/parameters.h"
#include "ardee_sim/description/shape_fault.h"
#include "ardee_sim/readers/sdf_parts.h"
#include "ardee_sim/readers/urdf.h"

namespace ardee {
namespace {

double number(const Node& shape, const char* name) {
  shape.required_attribute(name);
  return shape.attribute_number(name, 0.0);
}

Box read_box(const Node& shape) {
  shape.required_attribute("size");
  return {shape.attribute_vector3("size", {})};
}

Geometry read_shape(const Node& shape, Assets& assets) {
  const std::string_view kind = shape.name();
  if (kind == "box") return read_box(shape);
  if (kind == "sphere") return Sphere{number(shape, "radius")};
  if (kind == "cylinder") return Cylinder{number(shape, "radius"), number(shape, "length")};
  if (kind == "mesh") {
    const Eigen::Vector3d scale = shape.attribute_vector3("scale", Eigen::Vector3d::Ones());
    return make_mesh(shape.required_attribute("filename"), "", false, scale, shape.source(),
                     assets);
  }
  throw shape.error("found this shape, expected box, sphere, cylinder or mesh");
}

std::optional<Geometry> read_geometry(const Node& body, Assets& assets) {
  std::optional<Geometry> made;
  bool found = false;
  const auto geometry = body.child("geometry");
  if (geometry) {
    geometry->each([&](const Node& shape) {
      if (found) throw shape.error("found a second shape in a <geometry>, expected one");
      found = true;
      assets.has_files([&] { made = read_shape(shape, assets); });
      const auto fault = made ? find_fault(*made) : std::nullopt;
      if (!fault) return;
      throw shape.error("found " + std::string(fault->field) + "='" +
                        shape.attribute(fault->field) + "', expected " + fault->expected);
    });
  }
  if (!found) {
    assets.log().warn(body.source(), "found no shape in it, expected a <geometry>; left out");
  }
  return made;
}

/// Name as libsdformat gives it: base_collision, base_collision_1, ...
std::string body_name(const Node& body, const std::string& link, const char* kind,
                      std::size_t index) {
  const std::string given = body.attribute("name");
  if (!given.empty()) return given;
  return link + "_" + kind + (index == 0 ? "" : "_" + std::to_string(index));
}

/// A required number; accepts "nan", which a link that never moves may have.
double read_inertia(const Node& element, const char* name) {
  const std::string text = element.required_attribute(name);
  const auto value = to_double(text);
  return value && std::isnan(*value) ? *value : element.attribute_number(name, 0.0);
}

std::optional<Inertial> read_inertial(const Node& link) {
  const auto inertial = link.child("inertial");
  if (!inertial) return std::nullopt;
  Inertial made;
  made.X_LI = read_urdf_origin(*inertial);
  made.mass_kg = read_inertia(inertial->required("mass"), "value");
  const Node inertia = inertial->required("inertia");
  const double xx = read_inertia(inertia, "ixx");
  const double xy = read_inertia(inertia, "ixy");
  const double xz = read_inertia(inertia, "ixz");
  const double yy = read_inertia(inertia, "iyy");
  const double yz = read_inertia(inertia, "iyz");
  const double zz = read_inertia(inertia, "izz");
  made.inertia_kg_m2 << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return made;
}

/// The material of an element; none if it holds only a name.
std::optional<Material> read_material(const Node& node, Assets& assets) {
  const auto color = node.child("color");
  const auto texture = node.child("texture");
  const std::string file = texture ? texture->attribute("filename") : "";
  if (!color && file.empty()) return std::nullopt;
  Material made;
  made.name = node.attribute("name");
  made.diffuse = Color{0, 0, 0, 1};
  if (color) {
    color->required_attribute("rgba");
    const std::vector<double> rgba = color->attribute_numbers("rgba", 3, 4);
    for (std::size_t i = 0; i < rgba.size(); ++i) {
      made.diffuse[static_cast<int>(i)] = static_cast<float>(rgba[i]);
    }
    made.diffuse = made.diffuse.cwiseMax(0.0f).cwiseMin(1.0f);
  }
  if (!file.empty()) {
    made.texture_path = assets.texture(file, texture->source());
    if (made.diffuse.head<3>().isZero()) made.diffuse.setOnes();  // a texture without a colour
  }
  made.ambient = made.diffuse;
  return made;
}

}  // namespace

UrdfMaterials::UrdfMaterials(const Node& robot, Assets& assets) : assets_(assets) {
  robot.each("material", [&](const Node& node) {
    const std::string name = node.required_attribute("name");
    const auto made = read_material(node, assets);
    if (!made) throw node.error("found no <color> and no <texture>, expected one");
    if (!by_name_.emplace(name, *made).second) {
      throw node.error("found a second material '" + name + "', expected unique names");
    }
  });
}

std::optional<Material> UrdfMaterials::read(const Node& visual) {
  const auto node = visual.child("material");
  if (!node) return std::nullopt;
  const auto own = read_material(*node, assets_);
  const std::string name = node->attribute("name");
  if (name.empty()) return own;
  const auto known = by_name_.find(name);
  if (known != by_name_.end()) return known->second;
  if (own) {
    by_name_.emplace(name, *own);
  } else {
    assets_.log().warn(node->source(), "found material '" + name +
                                           "', expected one that has a <color> or <texture> in the "
                                           "robot; the default is used");
  }
  return own;
}

Pose read_urdf_origin(const Node& element) {
  const auto origin = element.child("origin");
  if (!origin) return {};
  return Pose::from_xyz_rpy(origin->attribute_vector3("xyz", Eigen::Vector3d::Zero()),
                            origin->attribute_vector3("rpy", Eigen::Vector3d::Zero()));
}

Link read_urdf_link(const Node& node, UrdfMaterials& materials, Assets& assets) {
  Link made;
  made.name = node.required_attribute("name");
  made.source = node.source();
  made.inertial = read_inertial(node);
  node.each("collision", [&](const Node& body) {
    if (auto geometry = read_geometry(body, assets)) {
      Collision collision;
      collision.name = body_name(body, made.name, "collision", made.collisions.size());
      collision.X_LC = read_urdf_origin(body);
      collision.geometry = std::move(*geometry);
      made.collisions.push_back(std::move(collision));
    }
  });
  node.each("visual", [&](const Node& body) {
    if (auto geometry = read_geometry(body, assets)) {
      Visual visual;
      visual.name = body_name(body, made.name, "visual", made.visuals.size());
      visual.X_LV = read_urdf_origin(body);
      visual.geometry = std::move(*geometry);
      visual.material = materials.read(body);
      made.visuals.push_back(std::move(visual));
    }
  });
  return made;
}

}  // namespace ardee
