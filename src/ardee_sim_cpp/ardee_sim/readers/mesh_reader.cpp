// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_reader.h"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <set>

#include "ardee_sim/readers/mesh_file_check.h"
#include "ardee_sim/readers/mesh_file_repair.h"
#include "ardee_sim/readers/mesh_materials.h"
#include "ardee_sim/readers/polygon.h"

namespace Assimp {

/// Replaces the mesh library's function of this name, which ends the process: a failed assertion
/// about a file becomes an ordinary error.
ASSIMP_API void aiAssertViolation(const char* failed, const char* file, int line);
void aiAssertViolation(const char* failed, const char* /*file*/, int /*line*/) {
  throw ardee::Error(std::string("the mesh library expects ") + failed);
}

}  // namespace Assimp

namespace ardee {
namespace {

constexpr std::size_t kMaxTriangles = 20'000'000;
/// Greatest number of a polygon's corners: the time to cut it grows with their cube.
constexpr std::size_t kMaxCorners = 1000;
/// Greatest number of comparisons of corners when the polygons of a file are cut: some seconds.
constexpr std::uint64_t kMaxWork = 2'000'000'000;
constexpr float kAbsurdCoordinate = 1e9f;

/// Parts of a file that are not in the mesh.
struct LeftOut {
  std::size_t points = 0;
  std::size_t lines = 0;
  std::size_t flat_faces = 0;
  std::size_t pictures = 0;

  std::string in_words() const {
    std::string words;
    const auto add = [&words](std::size_t count, const char* what) {
      if (count > 0) words += (words.empty() ? "" : ", ") + std::to_string(count) + what;
    };
    add(points, " point(s)");
    add(lines, " line(s)");
    add(flat_faces, " face(s) without area");
    add(pictures, " picture(s) inside the file");
    return words;
  }
};

/// Gives `bytes` for the file at `path`, and reads other files from the disk.
class OneFileInMemory : public Assimp::DefaultIOSystem {
 public:
  OneFileInMemory(std::string path, const std::string& bytes)
      : path_(std::move(path)), bytes_(bytes) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (file != path_) return DefaultIOSystem::Open(file, mode);
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes_.data());
    return new Assimp::MemoryIOStream(data, bytes_.size());
  }

 private:
  std::string path_;
  const std::string& bytes_;
};

/// Sets the marks that the library's validation requires, and that its OBJ reader omits for a face
/// of two corners; faces of fewer than three corners are removed afterwards.
void mark_kinds_of_faces(const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    aiMesh& mesh = *scene.mMeshes[i];
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
      const unsigned corners = mesh.mFaces[k].mNumIndices;
      if (corners > 0) mesh.mPrimitiveTypes |= AI_PRIMITIVE_TYPE_FOR_N_INDICES(corners);
    }
  }
}

LeftOut count_left_out(const aiScene& scene) {
  LeftOut left_out;
  left_out.pictures = scene.mNumTextures;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
      if (mesh.mFaces[k].mNumIndices == 1) ++left_out.points;
      if (mesh.mFaces[k].mNumIndices == 2) ++left_out.lines;
    }
  }
  return left_out;
}

void set_properties(Assimp::Importer& importer) {
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_POINT | aiPrimitiveType_LINE);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_ANIMATIONS | aiComponent_LIGHTS | aiComponent_CAMERAS);
}

const aiScene& import(Assimp::Importer& importer, const std::string& path, const Source& source,
                      const std::string& bytes, LeftOut& left_out) {
  // Polygons are not triangulated by the library, whose triangles exceed some concave polygons.
  constexpr unsigned kSteps =
      aiProcess_JoinIdenticalVertices | aiProcess_SortByPType | aiProcess_ValidateDataStructure;
  set_properties(importer);
  const aiScene* scene = nullptr;
  try {
    importer.SetIOHandler(new OneFileInMemory(path, bytes));  // the importer owns it
    scene = importer.ReadFile(path, 0);
    if (scene) {
      mark_kinds_of_faces(*scene);
      left_out = count_left_out(*scene);
      // Two cameras of one name would fail the validation, and cameras are not used.
      scene = importer.ApplyPostProcessing(aiProcess_RemoveComponent);
    }
    if (scene) scene = importer.ApplyPostProcessing(kSteps);
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

  std::size_t flat_faces() const { return flat_faces_; }

  void read(const aiNode& node, const aiMatrix4x4& X_parent) {
    const aiMatrix4x4 X_node = X_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      add_part(node, mesh, X_node);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) read(*node.mChildren[i], X_node);
  }

 private:
  void add_part(const aiNode& node, const aiMesh& mesh, const aiMatrix4x4& X_node) {
    SubMesh part;
    part.name = node.mName.length > 0 ? node.mName.C_Str() : mesh.mName.C_Str();
    const Material& material = file_.materials.at(mesh.mMaterialIndex);
    // The library invents a material if the file has none.
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
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const std::size_t before = part.triangles.size();
      add_face(mesh.mFaces[i], i, part);
      for (std::size_t k = before; mirrored && k < part.triangles.size(); ++k) {
        std::swap(part.triangles[k][1], part.triangles[k][2]);
      }
      if (part.triangles.size() == before) ++flat_faces_;
      count_ += part.triangles.size() - before;
      if (count_ > kMaxTriangles) {
        throw Error(source_, "found more than " + std::to_string(kMaxTriangles) +
                                 " triangles in '" + file_.path + "', expected fewer");
      }
    }
  }

  void add_face(const aiFace& face, unsigned number, SubMesh& part) {
    std::vector<Eigen::Vector3f> corners;
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= part.vertices.size()) {
        throw wrong_face(number, part, "vertex " + std::to_string(face.mIndices[k]),
                         "less than " + std::to_string(part.vertices.size()));
      }
      corners.push_back(part.vertices[face.mIndices[k]]);
    }
    if (corners.size() > kMaxCorners) {
      throw wrong_face(number, part, std::to_string(corners.size()) + " corners",
                       "at most " + std::to_string(kMaxCorners));
    }
    const unsigned* index = face.mIndices;
    if (corners.size() == 3) {
      if (index[0] != index[1] && index[1] != index[2] && index[2] != index[0]) {
        part.triangles.push_back({index[0], index[1], index[2]});
      }
      return;
    }
    for (const auto& cut : cut_polygon(corners, &work_)) {
      part.triangles.push_back({index[cut[0]], index[cut[1]], index[cut[2]]});
    }
    if (work_ > kMaxWork) {
      throw Error(source_, "found too many polygons of many corners in '" + file_.path +
                               "', expected fewer, or triangles");
    }
  }

  Error wrong_face(unsigned number, const SubMesh& part, const std::string& found,
                   const std::string& expected) const {
    return Error(source_, "found face " + std::to_string(number) + " of part '" + part.name +
                              "' in '" + file_.path + "' with " + found + ", expected " + expected);
  }

  const aiScene& scene_;
  MeshFile& file_;
  const Source& source_;
  std::size_t count_ = 0;
  std::uint64_t work_ = 0;
  std::size_t flat_faces_ = 0;
};

}  // namespace

MeshFile read_mesh_file(const std::string& path, const Source& source, Log& log) {
  const std::string bytes = repair_mesh_file(check_mesh_file(path, source), path, source, log);
  MeshFile file;
  file.path = path;
  Assimp::Importer importer;
  LeftOut left_out;
  const aiScene& scene = import(importer, path, source, bytes, left_out);
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    file.materials.push_back(read_mesh_material(*scene.mMaterials[i], path));
  }
  PartReader reader(scene, file, source);
  reader.read(*scene.mRootNode, aiMatrix4x4());
  left_out.flat_faces = reader.flat_faces();
  if (file.parts.empty()) {
    throw Error(source, "found no triangles in '" + path + "', expected some");
  }
  const std::string words = left_out.in_words();
  if (!words.empty()) log.warn(source.to_string() + ": left out of '" + path + "': " + words);
  return file;
}

std::vector<std::string> part_names(const MeshFile& file) {
  std::vector<std::string> names;
  std::set<std::string> given;
  for (const SubMesh& part : file.parts) {
    if (given.insert(part.name).second) names.push_back(part.name);
  }
  return names;
}

}  // namespace ardee
