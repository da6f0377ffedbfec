// SPDX-License-Identifier: MIT
#include "ros/marker_shapes.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

#include "ros/conversions.h"

namespace ardee::node {
namespace {

using visualization_msgs::Marker;

constexpr double kPlaneThickness_m = 0.001;
constexpr double kEverywhere_m = std::numeric_limits<double>::infinity();

std_msgs::ColorRGBA color_of(const Material& material, double transparency) {
  std_msgs::ColorRGBA color;
  color.r = material.diffuse[0];
  color.g = material.diffuse[1];
  color.b = material.diffuse[2];
  color.a = material.diffuse[3] * static_cast<float>(1.0 - transparency);
  return color;
}

/// Fills a marker in with the geometry of one visual; one overload per kind.
class ShapeMaker {
 public:
  ShapeMaker(const Visual& visual, const Pose& X_ML) {
    shape_.X_MS = X_ML * visual.X_LV;
    shape_.marker.color =
        color_of(visual.material ? *visual.material : Material{}, visual.transparency);
    has_material_ = visual.material.has_value();
    has_plain_color_ = has_material_ && visual.material->texture_path.empty();
  }

  void operator()(const Box& box) { set(Marker::CUBE, box.size_m, box.size_m.norm() / 2.0); }
  void operator()(const Sphere& sphere) {
    set(Marker::SPHERE, Eigen::Vector3d::Constant(2.0 * sphere.radius_m), sphere.radius_m);
  }
  void operator()(const Cylinder& cylinder) {
    const double width = 2.0 * cylinder.radius_m;
    set(Marker::CYLINDER, {width, width, cylinder.length_m},
        Eigen::Vector2d(width, cylinder.length_m).norm() / 2.0);
  }
  void operator()(const Plane& plane) {
    set(Marker::CUBE, {plane.size_m.x(), plane.size_m.y(), kPlaneThickness_m}, kEverywhere_m);
    Pose X_VP;
    X_VP.q = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), plane.normal);
    X_VP.p = -0.5 * kPlaneThickness_m * plane.normal.normalized();
    shape_.X_MS = shape_.X_MS * X_VP;
  }
  void operator()(const Heightmap& heightmap) {
    set(Marker::TRIANGLE_LIST, Eigen::Vector3d::Ones(), kEverywhere_m);
    shape_.heightmap = &heightmap;
  }
  /// Only the named part of the file.
  void operator()(const Mesh& mesh) {
    set(Marker::TRIANGLE_LIST, mesh.scale, 0.0);
    const SubMesh* last = nullptr;
    Eigen::AlignedBox3f bounds;
    for (const SubMesh& part : mesh.file->parts) {
      if (!mesh.submesh.empty() && part.name != mesh.submesh) continue;
      for (const auto& triangle : part.triangles) {
        for (const std::uint32_t corner : triangle) append(part.vertices[corner], bounds);
      }
      last = &part;
    }
    if (mesh.center && !bounds.isEmpty()) move(-bounds.center());
    if (!has_material_ && last && last->material >= 0) {
      shape_.marker.color =
          color_of(mesh.file->materials[static_cast<std::size_t>(last->material)], 0.0);
    }
    if (!bounds.isEmpty()) reach(mesh.scale, bounds);
  }
  /// The whole file, with its own materials if it has any. A plain colour of its `only` visual
  /// replaces them: the mesh library gives STL files a grey of its own.
  void whole_file(const Mesh& mesh, bool only) {
    set(Marker::MESH_RESOURCE, mesh.scale, 0.0);
    Eigen::AlignedBox3f bounds;
    for (const SubMesh& part : mesh.file->parts) {
      for (const Eigen::Vector3f& vertex : part.vertices) bounds.extend(vertex);
    }
    if (!bounds.isEmpty()) reach(mesh.scale, bounds);
    shape_.marker.mesh_resource = file_uri(mesh.file->path);
    // The crop models' second level of detail lies beside the first.
    const std::filesystem::path path(mesh.file->path);
    const std::filesystem::path coarse =
        path.parent_path() / (path.stem().string() + "_lod1" + path.extension().string());
    std::error_code absent;
    if (std::filesystem::exists(coarse, absent)) shape_.coarse_path = coarse.string();
    shape_.marker.mesh_use_embedded_materials =
        !(only && has_plain_color_) && !mesh.file->materials.empty();
    // rviz tints embedded materials with any colour except all zeros.
    if (shape_.marker.mesh_use_embedded_materials) shape_.marker.color = std_msgs::ColorRGBA();
  }

  MarkerShape take() { return std::move(shape_); }

 private:
  void set(int type, const Eigen::Vector3d& scale, double reach_m) {
    shape_.marker.type = type;
    shape_.marker.scale = to_vector(scale);
    shape_.reach_m = reach_m + shape_.X_MS.p.norm();
  }
  void append(const Eigen::Vector3f& vertex, Eigen::AlignedBox3f& bounds) {
    bounds.extend(vertex);
    shape_.marker.points.push_back(to_point(vertex.cast<double>()));
  }
  void move(const Eigen::Vector3f& by) {
    for (geometry_msgs::Point& point : shape_.marker.points) {
      point = to_point(from_ros(point) + by.cast<double>());
    }
  }
  void reach(const Eigen::Vector3d& scale, const Eigen::AlignedBox3f& bounds) {
    const Eigen::Vector3d farthest =
        bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).cast<double>();
    shape_.reach_m += farthest.cwiseProduct(scale).norm();
  }

  MarkerShape shape_;
  bool has_material_ = false;
  bool has_plain_color_ = false;
};

bool same_place(const Visual& a, const Visual& b) {
  const Mesh* mesh_a = std::get_if<Mesh>(&a.geometry);
  const Mesh* mesh_b = std::get_if<Mesh>(&b.geometry);
  return mesh_a && mesh_b && mesh_a->file == mesh_b->file && mesh_a->scale == mesh_b->scale &&
         !mesh_a->center && !mesh_b->center && a.X_LV.p == b.X_LV.p &&
         a.X_LV.q.coeffs() == b.X_LV.q.coeffs();
}

/// The visuals that show parts of the same file at the same place as `first`; empty unless together
/// they show all of it.
std::vector<const Visual*> whole_file_of(const Link& link, const Visual& first) {
  std::vector<const Visual*> group;
  std::set<std::string> shown;
  bool all = false;
  for (const Visual& visual : link.visuals) {
    if (!same_place(first, visual)) continue;
    group.push_back(&visual);
    const std::string& submesh = std::get<Mesh>(visual.geometry).submesh;
    all = all || submesh.empty();
    shown.insert(submesh);
  }
  if (group.empty()) return {};
  const auto& parts = std::get<Mesh>(first.geometry).file->parts;
  const auto is_shown = [&](const SubMesh& part) { return shown.count(part.name) > 0; };
  if (!all && !std::all_of(parts.begin(), parts.end(), is_shown)) return {};
  return group;
}

}  // namespace

std::string file_uri(const std::string& path) {
  static constexpr char kHex[] = "0123456789ABCDEF";
  std::string uri = "file://";
  for (const char each : std::filesystem::absolute(path).string()) {
    if (std::isalnum(static_cast<unsigned char>(each)) ||
        std::string("/._-~").find(each) != std::string::npos) {
      uri += each;
    } else {
      const auto byte = static_cast<unsigned char>(each);
      uri += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return uri;
}

std::vector<MarkerShape> marker_shapes(const Model& model) {
  std::vector<MarkerShape> shapes;
  for (const Link& link : model.links) {
    std::set<const Visual*> done;
    for (const Visual& visual : link.visuals) {
      if (done.count(&visual) > 0) continue;
      ShapeMaker maker(visual, link.X_ML);
      const std::vector<const Visual*> group = whole_file_of(link, visual);
      if (group.empty()) {
        std::visit(maker, visual.geometry);
      } else {
        maker.whole_file(std::get<Mesh>(visual.geometry), group.size() == 1);
        done.insert(group.begin(), group.end());
      }
      shapes.push_back(maker.take());
    }
  }
  return shapes;
}

}  // namespace ardee::node
