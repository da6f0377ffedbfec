// SPDX-License-Identifier: MIT
// Visible shapes of models, for viewers.
#include "descriptions.h"

#include <pybind11/eigen.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <variant>

#include "arrays.h"

namespace ardee::python {
namespace {

using namespace pybind11::literals;

py::dict to_dict(const Material& material, double transparency) {
  Eigen::Vector4d rgba = material.diffuse.cast<double>();
  rgba[3] *= std::clamp(1.0 - transparency, 0.0, 1.0);
  return py::dict("rgba"_a = rgba,
                  "emissive"_a = Eigen::Vector3d(material.emissive.head<3>().cast<double>()),
                  "texture"_a = material.texture_path, "two_sided"_a = material.two_sided,
                  "alpha_rejection"_a = material.alpha_rejection);
}

/// Collects the shapes of a visual as dicts: kind, its numbers, material.
class VisualShapes {
 public:
  VisualShapes(const Visual& visual, py::list& shapes) : visual_(visual), shapes_(shapes) {}

  void operator()(const Box& box) { add("box", nullptr, "size_m"_a = box.size_m); }
  void operator()(const Sphere& sphere) { add("sphere", nullptr, "radius_m"_a = sphere.radius_m); }
  void operator()(const Cylinder& cylinder) {
    add("cylinder", nullptr, "radius_m"_a = cylinder.radius_m, "length_m"_a = cylinder.length_m);
  }
  void operator()(const Plane& plane) {
    add("plane", nullptr, "normal"_a = plane.normal, "size_m"_a = plane.size_m);
  }
  void operator()(const Mesh& mesh) {
    Eigen::AlignedBox3f bounds;
    for (const SubMesh* part : parts_of(mesh)) {
      for (const Eigen::Vector3f& vertex : part->vertices) bounds.extend(vertex);
    }
    Eigen::Vector3f center = Eigen::Vector3f::Zero();
    if (mesh.center && !bounds.isEmpty()) center = bounds.center();
    for (const SubMesh* part : parts_of(mesh)) add_part(*part, mesh, center);
  }
  void operator()(const Heightmap& map) {
    py::list textures;
    for (const GroundTexture& each : map.textures) {
      textures.append(py::make_tuple(each.diffuse_path, each.size_m));
    }
    py::list blends;
    for (const GroundBlend& each : map.blends) {
      blends.append(py::make_tuple(each.min_height_m, each.fade_m));
    }
    const std::shared_ptr<const HeightGrid>& grid = map.grid;
    add("heightmap", nullptr,
        "heights_m"_a = view(grid->heights_m.data(), {grid->rows, grid->columns}, grid),
        "size_m"_a = grid->size_m, "position_m"_a = map.position_m, "textures"_a = textures,
        "blends"_a = blends);
  }

 private:
  static std::vector<const SubMesh*> parts_of(const Mesh& mesh) {
    std::vector<const SubMesh*> parts;
    for (const SubMesh& part : mesh.file->parts) {
      if (mesh.submesh.empty() || part.name == mesh.submesh) parts.push_back(&part);
    }
    return parts;
  }

  void add_part(const SubMesh& part, const Mesh& mesh, const Eigen::Vector3f& center) {
    const auto count = static_cast<py::ssize_t>(part.vertices.size());
    std::vector<float> vertices, texcoords;
    for (const Eigen::Vector3f& vertex : part.vertices) {
      const Eigen::Vector3f placed = mesh.scale.cast<float>().cwiseProduct(vertex - center);
      vertices.insert(vertices.end(), placed.data(), placed.data() + 3);
    }
    for (const Eigen::Vector2f& each : part.texcoords) {
      texcoords.insert(texcoords.end(), each.data(), each.data() + 2);
    }
    const bool mirrored = mesh.scale.prod() < 0.0;
    std::vector<std::uint32_t> triangles;
    for (std::array<std::uint32_t, 3> corners : part.triangles) {
      if (mirrored) std::swap(corners[1], corners[2]);
      triangles.insert(triangles.end(), corners.begin(), corners.end());
    }
    const auto& materials = mesh.file->materials;
    const auto index = static_cast<std::size_t>(part.material);
    const bool has_own = part.material >= 0 && index < materials.size();
    add("mesh", has_own ? &materials[index] : nullptr,
        "vertices_m"_a = hold(std::move(vertices), {count, 3}),
        "texcoords"_a =
            hold(std::move(texcoords), {static_cast<py::ssize_t>(part.texcoords.size()), 2}),
        "triangles"_a =
            hold(std::move(triangles), {static_cast<py::ssize_t>(part.triangles.size()), 3}));
  }

  template <typename... Numbers>
  void add(const char* kind, const Material* own, Numbers&&... numbers) {
    const Material plain;
    const Material* material = visual_.material ? &*visual_.material : own;
    shapes_.append(py::dict(
        "kind"_a = kind, "xyz_m"_a = visual_.X_LV.p,
        "quat_xyzw"_a = Eigen::Vector4d(visual_.X_LV.q.coeffs()),
        "has_material"_a = material != nullptr,
        "material"_a = to_dict(material != nullptr ? *material : plain, visual_.transparency),
        std::forward<Numbers>(numbers)...));
  }

  const Visual& visual_;
  py::list& shapes_;
};

/// Returns a tuple for each link: name, position and quaternion in the model at rest, shapes.
py::list links_of(const Model& model) {
  py::list links;
  for (const Link& link : model.links) {
    py::list shapes;
    for (const Visual& visual : link.visuals)
      std::visit(VisualShapes(visual, shapes), visual.geometry);
    links.append(
        py::make_tuple(link.name, link.X_ML.p, Eigen::Vector4d(link.X_ML.q.coeffs()), shapes));
  }
  return links;
}

}  // namespace

void bind_description(py::module_& module) {
  py::class_<ardee::Model, std::shared_ptr<ardee::Model>>(module, "Description")
      .def_readonly("name", &ardee::Model::name)
      .def("links", &links_of);
}

py::object to_python(const std::shared_ptr<const Model>& model) {
  return py::cast(std::const_pointer_cast<Model>(model));
}

}  // namespace ardee::python
