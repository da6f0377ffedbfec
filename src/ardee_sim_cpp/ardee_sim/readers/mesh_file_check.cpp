// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_file_check.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "ardee_sim/readers/text_file.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 29;

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// A binary STL says its number of triangles; an ASCII one ends in "endsolid".
void check_stl(const std::string& bytes, const std::string& path, const Source& source) {
  constexpr std::size_t kHeader = 84;
  constexpr std::size_t kTriangle = 50;
  std::uint32_t count = 0;
  if (bytes.size() >= kHeader) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  if (bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * count) return;
  if (bytes.compare(0, 5, "solid") == 0 && bytes.find("facet") != std::string::npos) {
    if (bytes.find("endsolid") != std::string::npos) return;
    throw Error(source, "found no 'endsolid' in STL '" + path + "', expected a whole file");
  }
  if (bytes.size() < kHeader || bytes.size() < kHeader + kTriangle * count) {
    throw Error(source, "found " + std::to_string(bytes.size()) + " bytes in STL '" + path +
                            "', expected " + std::to_string(kHeader + kTriangle * count) +
                            " for its " + std::to_string(count) + " triangles");
  }
}

}  // namespace

void check_mesh_file(const std::string& path, const Source& source) {
  const std::string extension = lower_extension(path);
  if (extension != ".dae" && extension != ".stl" && extension != ".obj" && extension != ".ply") {
    throw Error(source, "found mesh '" + path + "', expected a .dae, .stl, .obj or .ply file");
  }
  const std::string bytes = read_text_file(path, source, kMaxFileBytes);
  if (bytes.empty()) throw Error(source, "found an empty mesh file '" + path + "', expected data");
  if (extension == ".stl") check_stl(bytes, path, source);
  if (extension == ".dae") check_xml_text(bytes, path);
}

}  // namespace ardee
