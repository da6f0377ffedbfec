// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "ardee_sim/description/material.h"

namespace ardee {

/// One named part of a mesh file, in the file's frame and in metres (node transforms and units
/// applied).
struct SubMesh {
  std::string name;  // the DAE node's name, else the mesh's
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;  // per vertex; empty if the file has none
  std::vector<Eigen::Vector2f>
      texcoords;  // per vertex, v upwards from the image's lower edge; empty if none
  std::vector<std::array<std::uint32_t, 3>> triangles;
  int material = -1;  // index into MeshFile::materials, or -1
};

/// A mesh file as read: shared by all that refer to it.
struct MeshFile {
  std::string path;
  std::vector<SubMesh> parts;
  std::vector<Material> materials;
};

/// Heights on a regular grid that spans `size` about the origin. Column 0 lies at -x, row 0 at -y.
struct HeightGrid {
  int columns = 0;
  int rows = 0;
  Eigen::Vector2d size_m{0, 0};
  std::vector<float> heights_m;  // row-major

  float at(int column, int row) const {
    return heights_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
  }
};

struct Box {
  Eigen::Vector3d size_m{1, 1, 1};
};
struct Sphere {
  double radius_m = 1.0;
};
/// Cylinder along z, centred at the origin.
struct Cylinder {
  double radius_m = 1.0;
  double length_m = 1.0;
};
/// Plane, infinite for collisions; `size_m` bounds its visible part.
struct Plane {
  Eigen::Vector3d normal{0, 0, 1};
  Eigen::Vector2d size_m{1, 1};
};
struct Mesh {
  std::shared_ptr<const MeshFile> file;
  std::string uri;      // as written
  std::string submesh;  // empty: all parts
  bool center = false;  // the submesh is moved so that its bounding box is centred at the origin
  Eigen::Vector3d scale{1, 1, 1};
};
/// One of the ground textures of a heightmap; layer k + 1 fades in over `fade_m` above
/// `min_height_m` of blend k.
struct GroundTexture {
  std::string diffuse_path;
  double size_m = 10.0;
};
struct GroundBlend {
  double min_height_m = 0.0;
  double fade_m = 0.0;
};
struct Heightmap {
  std::shared_ptr<const HeightGrid> grid;
  std::string uri;
  Eigen::Vector3d position_m{0, 0, 0};
  std::vector<GroundTexture> textures;
  std::vector<GroundBlend> blends;
};

using Geometry = std::variant<Box, Sphere, Cylinder, Plane, Mesh, Heightmap>;

}  // namespace ardee
