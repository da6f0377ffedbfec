// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_reader.h"
#include "fixture.h"

// Assimp forgets some memory when it refuses a broken file; a leak check is to look at our own
// code.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }

namespace ardee {
namespace {

MeshFile read(const std::string& name) {
  return read_mesh_file(std::string(ARDEE_TEST_DATA "/meshes/") + name, Source{"test", 1, "uri"});
}

void expect_box(const SubMesh& part, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  Eigen::Vector3f least = part.vertices.at(0);
  Eigen::Vector3f most = least;
  for (const Eigen::Vector3f& vertex : part.vertices) {
    least = least.cwiseMin(vertex);
    most = most.cwiseMax(vertex);
  }
  EXPECT_LT((least - low).norm(), 1e-5f) << least.transpose();
  EXPECT_LT((most - high).norm(), 1e-5f) << most.transpose();
}

/// By the divergence theorem; positive if the triangles face outwards.
double volume(const SubMesh& part) {
  double sum = 0.0;
  for (const auto& t : part.triangles) {
    sum += part.vertices[t[0]].dot(part.vertices[t[1]].cross(part.vertices[t[2]])) / 6.0;
  }
  return sum;
}

TEST(MeshReader, ReadsEachFormat) {
  for (const char* name : {"cube.stl", "solid_header.stl", "cube.obj", "two_sided.dae"}) {
    const MeshFile file = read(name);
    ASSERT_EQ(file.parts.size(), 1u) << name;
    EXPECT_EQ(file.parts[0].triangles.size(), 12u) << name;
    expect_box(file.parts[0], {0, 0, 0}, {1, 1, 1});
    EXPECT_NEAR(volume(file.parts[0]), 1.0, 1e-6) << name;
  }
}

TEST(MeshReader, AppliesNodeTransformsAndNamesPartsByNode) {
  const MeshFile file = read("parts_z_up.dae");
  ASSERT_EQ(file.parts.size(), 2u);
  EXPECT_EQ(file.parts[0].name, "Stem");
  expect_box(file.parts[0], {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(file.parts[1].name, "Leaf");
  expect_box(file.parts[1], {9, 0, 0}, {10, 1, 1});
  EXPECT_EQ(part_names(file), "'Stem', 'Leaf'");
}

TEST(MeshReader, AppliesTheUnitAndNotTheUpAxis) {
  expect_box(read("parts_inch.dae").parts.at(1), {9 * 0.0254f, 0, 0}, {0.254f, 0.0254f, 0.0254f});
  expect_box(read("parts_y_up.dae").parts.at(1), {9, 0, 0}, {10, 1, 1});
}

TEST(MeshReader, KeepsTrianglesOutwardsUnderAMirror) {
  const MeshFile file = read("mirrored.dae");
  expect_box(file.parts.at(0), {-1, 0, 0}, {0, 1, 1});
  EXPECT_NEAR(volume(file.parts.at(0)), 1.0, 1e-6);
}

TEST(MeshReader, ReadsMaterials) {
  const MeshFile one_sided = read("parts_z_up.dae");
  const Material& material =
      one_sided.materials.at(static_cast<std::size_t>(one_sided.parts.at(0).material));
  EXPECT_TRUE(material.diffuse.isApprox(Color(0.2f, 0.4f, 0.6f, 1)));
  EXPECT_FALSE(material.two_sided);
  EXPECT_TRUE(read("two_sided.dae").materials.at(0).two_sided);
  EXPECT_EQ(read("cube.stl").parts.at(0).material, -1);
}

TEST(MeshReader, FindsTexturesBesideTheMeshAndInTheModelsFolder) {
  const TempFolder folder;
  const std::string obj =
      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n";
  const std::string path = folder.write("meshes/m.obj", obj);
  folder.write("meshes/m.mtl", "newmtl a\nKd 0.5 0.5 0.5\nmap_Kd leaf.png\n");
  EXPECT_EQ(read_mesh_file(path, {}).materials.back().texture_path, "");
  const std::string in_model = folder.write("materials/textures/leaf.png", "x");
  EXPECT_EQ(read_mesh_file(path, {}).materials.back().texture_path, in_model);
  const std::string beside = folder.write("meshes/leaf.png", "x");
  const MeshFile file = read_mesh_file(path, {});
  EXPECT_EQ(file.materials.back().texture_path, beside);
  // v counts upwards from the picture's lower edge, as in the file.
  EXPECT_EQ(file.parts.at(0).texcoords.at(2), Eigen::Vector2f(0, 1));
}

}  // namespace
}  // namespace ardee
