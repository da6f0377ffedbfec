// SPDX-License-Identifier: MIT
#include "ros/far_plants.h"

#include <ros/console.h>

#include <array>
#include <cmath>
#include <optional>

#include "ardee_sim/image/image.h"
#include "ardee_sim/readers/mesh_reader.h"
#include "ardee_sim/render/texture.h"
#include "ros/conversions.h"

namespace ardee::node {
namespace {

/// Brightness of a triangle, as rviz does not light triangles with their own colours: light from
/// above and a little from the side, on both sides of a leaf.
float brightness(const Eigen::Vector3f& normal) {
  const Eigen::Vector3f to_sun = Eigen::Vector3f(0.3f, -0.4f, 1.0f).normalized();
  return 0.6f + 0.4f * std::abs(normal.dot(to_sun));
}

std_msgs::ColorRGBA shaded(const Color& color, float light) {
  std_msgs::ColorRGBA message;
  message.r = std::min(1.0f, color[0] * light);
  message.g = std::min(1.0f, color[1] * light);
  message.b = std::min(1.0f, color[2] * light);
  message.a = 1.0f;
  return message;
}

/// The colours of one part of a mesh file: its texture if it has one, else its material.
class Paint {
 public:
  Paint(const MeshFile& file, const SubMesh& part) : part_(part) {
    if (part.material < 0) return;
    const Material& material = file.materials[static_cast<std::size_t>(part.material)];
    diffuse_ = material.diffuse;
    if (material.texture_path.empty() || part.texcoords.empty()) return;
    const Source source{file.path, 0, "texture"};
    texture_.emplace(read_color_image(material.texture_path, source));
  }

  /// Colour near a corner of a triangle, half-way to its middle: coarse leaves have corners only at
  /// their edges, whose colour is not the leaf's.
  Color at(const std::array<std::uint32_t, 3>& corners, std::uint32_t corner) const {
    constexpr double kFootprint = 0.05;  // of the texture's width: no veins from afar
    if (!texture_) return diffuse_;
    const auto texcoord = [&](std::uint32_t vertex) -> Eigen::Vector2d {
      return part_.texcoords[vertex].cast<double>();
    };
    const Eigen::Vector2d sum = texcoord(corners[0]) + texcoord(corners[1]) + texcoord(corners[2]);
    return texture_->color(0.5 * texcoord(corner) + sum / 6.0, kFootprint);
  }

 private:
  const SubMesh& part_;
  Color diffuse_{0.5f, 0.5f, 0.5f, 1.0f};
  std::optional<render::Texture> texture_;
};

}  // namespace

const FarPlants::Triangles& FarPlants::triangles_of(const std::string& path) {
  const auto found = files_.find(path);
  if (found != files_.end()) return found->second;
  Triangles& triangles = files_[path];
  try {
    Log quiet([](LogLevel, const std::string&) {});  // spawning has reported them
    const MeshFile file = read_mesh_file(path, Source{path, 0, "mesh"}, quiet);
    for (const SubMesh& part : file.parts) {
      const Paint paint(file, part);
      for (const auto& corners : part.triangles) {
        const Eigen::Vector3f& a = part.vertices[corners[0]];
        const Eigen::Vector3f edge = part.vertices[corners[1]] - a;
        const Eigen::Vector3f normal = edge.cross(part.vertices[corners[2]] - a).normalized();
        for (const std::uint32_t corner : corners) {
          triangles.corners.push_back(part.vertices[corner].cast<double>());
          triangles.colors.push_back(shaded(paint.at(corners, corner), brightness(normal)));
        }
      }
    }
  } catch (const Error& error) {
    ROS_WARN_STREAM(error.what() << "; it is not shown in /ardee/scenery from afar");
    triangles = {};
  }
  return triangles;
}

void FarPlants::append(const std::string& path, const Pose& X_WS, const Eigen::Vector3d& scale,
                       visualization_msgs::Marker& marker) {
  const Triangles& triangles = triangles_of(path);
  for (const Eigen::Vector3d& corner : triangles.corners) {
    marker.points.push_back(to_point(X_WS * scale.cwiseProduct(corner).eval()));
  }
  marker.colors.insert(marker.colors.end(), triangles.colors.begin(), triangles.colors.end());
}

}  // namespace ardee::node
