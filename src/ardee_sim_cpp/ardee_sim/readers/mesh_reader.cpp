// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_reader.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <set>

#include "ardee_sim/readers/mesh_file_check.h"
#include "ardee_sim/readers/mesh_materials.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxTriangles = 20'000'000;
constexpr float kAbsurdCoordinate = 1e9f;

const aiScene& import(Assimp::Importer& importer, const std::string& path, const Source& source) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                              aiProcess_SortByPType | aiProcess_ValidateDataStructure;
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFile(path, kSteps);
  } catch (const std::exception& problem) {
    throw Error(source, "cannot read mesh '" + path + "' (" + problem.what() + ")");
  }
  if (!scene || !scene->mRootNode || scene->mNumMeshes == 0) {
    const std::string why = importer.GetErrorString();
    throw Error(source, "found mesh '" + path + "', expected a readable one with triangles" +
                            (why.empty() ? "" : " (" + why + ")"));
  }
  return *scene;
}

/// Appends the parts of a node and of all below it, in the file's frame.
class PartReader {
 public:
  PartReader(const aiScene& scene, MeshFile& file, const Source& source)
      : scene_(scene), file_(file), source_(source) {}

  void read(const aiNode& node, const aiMatrix4x4& X_parent) {
    const aiMatrix4x4 X_node = X_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      if (mesh.mPrimitiveTypes == aiPrimitiveType_TRIANGLE) add_part(node, mesh, X_node);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) read(*node.mChildren[i], X_node);
  }

 private:
  void add_part(const aiNode& node, const aiMesh& mesh, const aiMatrix4x4& X_node) {
    SubMesh part;
    part.name = node.mName.length > 0 ? node.mName.C_Str() : mesh.mName.C_Str();
    const Material& material = file_.materials.at(mesh.mMaterialIndex);
    // The library makes up a material where the file has none.
    if (material.name != AI_DEFAULT_MATERIAL_NAME) {
      part.material = static_cast<int>(mesh.mMaterialIndex);
    }
    add_vertices(mesh, X_node, part);
    add_triangles(mesh, X_node.Determinant() < 0.0f, part);
    if (!part.triangles.empty()) file_.parts.push_back(std::move(part));
  }

  void add_vertices(const aiMesh& mesh, const aiMatrix4x4& X_node, SubMesh& part) {
    aiMatrix3x3 to_normal(X_node);
    to_normal.Inverse().Transpose();
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const aiVector3D v = X_node * mesh.mVertices[i];
      part.vertices.emplace_back(v.x, v.y, v.z);
      if (!(part.vertices.back().cwiseAbs().maxCoeff() < kAbsurdCoordinate)) {
        throw Error(source_, "found vertex " + std::to_string(i) + " of part '" + part.name +
                                 "' in '" + file_.path +
                                 "' at a place that is not finite, expected numbers");
      }
      if (mesh.HasNormals()) {
        const aiVector3D n = to_normal * mesh.mNormals[i];
        const Eigen::Vector3f normal(n.x, n.y, n.z);
        const float length = normal.norm();
        part.normals.push_back(length > 0.0f && std::isfinite(length)
                                   ? Eigen::Vector3f(normal / length)
                                   : Eigen::Vector3f::UnitZ());
      }
      if (mesh.HasTextureCoords(0)) {
        part.texcoords.emplace_back(mesh.mTextureCoords[0][i].x, mesh.mTextureCoords[0][i].y);
      }
    }
  }

  void add_triangles(const aiMesh& mesh, bool mirrored, SubMesh& part) {
    count_ += mesh.mNumFaces;
    if (count_ > kMaxTriangles) {
      throw Error(source_, "found more than " + std::to_string(kMaxTriangles) + " triangles in '" +
                               file_.path + "', expected fewer");
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;
      std::array<std::uint32_t, 3> t{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
      for (const std::uint32_t index : t) {
        if (index >= mesh.mNumVertices) {
          throw Error(source_, "found triangle " + std::to_string(i) + " of part '" + part.name +
                                   "' in '" + file_.path + "' with vertex " +
                                   std::to_string(index) + ", expected less than " +
                                   std::to_string(mesh.mNumVertices));
        }
      }
      if (mirrored) std::swap(t[1], t[2]);
      if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) part.triangles.push_back(t);
    }
  }

  const aiScene& scene_;
  MeshFile& file_;
  const Source& source_;
  std::size_t count_ = 0;
};

}  // namespace

MeshFile read_mesh_file(const std::string& path, const Source& source) {
  check_mesh_file(path, source);
  MeshFile file;
  file.path = path;
  Assimp::Importer importer;
  const aiScene& scene = import(importer, path, source);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    file.materials.push_back(read_mesh_material(*scene.mMaterials[i], path));
  }
  PartReader(scene, file, source).read(*scene.mRootNode, aiMatrix4x4());
  if (file.parts.empty()) {
    throw Error(source, "found no triangles in '" + path + "', expected some");
  }
  return file;
}

std::string part_names(const MeshFile& file) {
  std::string names;
  std::set<std::string> given;
  for (const SubMesh& part : file.parts) {
    if (given.insert(part.name).second) names += (names.empty() ? "'" : ", '") + part.name + "'";
  }
  return names;
}

}  // namespace ardee
