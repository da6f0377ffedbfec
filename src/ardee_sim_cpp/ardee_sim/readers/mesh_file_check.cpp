// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_file_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <set>
#include <string_view>

#include "ardee_sim/core/text_file.h"
#include "ardee_sim/readers/collada_check.h"
#include "ardee_sim/readers/xml.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{1} << 29;

/// Refuses a fourth corner, which the mesh library would ignore.
void check_facets(const std::string& text, const std::string& path, const Source& source) {
  constexpr std::size_t kCorners = 3;
  for (std::size_t at = text.find("outer loop"); at != std::string::npos;) {
    const std::size_t end = std::min(text.find("endloop", at), text.size());
    std::size_t corners = 0;
    for (std::size_t corner = text.find("vertex", at); corner < end;
         corner = text.find("vertex", corner + 1)) {
      ++corners;
    }
    if (corners != kCorners) {
      const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
      throw Error(source, "found a facet of " + std::to_string(corners) + " corners in STL '" +
                              path + "', line " + std::to_string(line) + ", expected 3");
    }
    at = text.find("outer loop", end);
  }
}

constexpr std::size_t kStlHeader = 84;
constexpr std::size_t kStlTriangle = 50;

/// Size of a binary STL with the number of triangles that it declares.
std::size_t whole_stl_size(const std::string& bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= kStlHeader) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  return kStlHeader + kStlTriangle * count;
}

bool is_ascii_stl(const std::string& bytes) {
  return bytes.size() != whole_stl_size(bytes) && bytes.compare(0, 5, "solid") == 0 &&
         bytes.find("facet") != std::string::npos;
}

/// Checks that an STL is complete: a binary one declares its number of triangles; an ASCII one ends
/// in "endsolid".
void check_stl(const std::string& bytes, const std::string& path, const Source& source) {
  if (is_ascii_stl(bytes)) {
    if (bytes.find("endsolid") == std::string::npos) {
      throw Error(source, "found no 'endsolid' in STL '" + path + "', expected a whole file");
    }
    return check_facets(bytes, path, source);
  }
  const std::size_t whole = whole_stl_size(bytes);
  if (bytes.size() < whole) {
    throw Error(source, "found " + std::to_string(bytes.size()) + " bytes in STL '" + path +
                            "', expected " + std::to_string(whole) + " for its " +
                            std::to_string((whole - kStlHeader) / kStlTriangle) + " triangles");
  }
}

/// Checks the length that a binary glTF declares.
void check_glb(const std::string& bytes, const std::string& path, const Source& source) {
  constexpr std::size_t kHeader = 12;
  std::uint32_t length = 0;
  if (bytes.size() >= kHeader) std::memcpy(&length, bytes.data() + 8, sizeof(length));
  if (bytes.compare(0, 4, "glTF") == 0 && length == bytes.size()) return;
  throw Error(source, "found " + std::to_string(bytes.size()) + " bytes in '" + path +
                          "', expected a whole binary glTF file");
}

/// Refuses a number after `key` that is larger than the file: the mesh library would reserve memory
/// for so many items.
void check_counts(const std::string& bytes, std::string_view key, const std::string& path,
                  const Source& source) {
  for (std::size_t at = bytes.find(key); at != std::string::npos; at = bytes.find(key, at)) {
    at += key.size();
    const std::size_t digits = std::min(bytes.find_first_not_of(" \t\r\n+\"'", at), bytes.size());
    std::uint64_t count = 0;
    const char* end = bytes.data() + bytes.size();
    const auto [stop, status] = std::from_chars(bytes.data() + digits, end, count);
    const bool negative = digits < bytes.size() && bytes[digits] == '-';
    if (negative || status == std::errc::result_out_of_range || count > bytes.size()) {
      throw Error(source, "found '" + bytes.substr(at, 20) + "' after '" + std::string(key) +
                              "' in '" + path + "', expected no more than its " +
                              std::to_string(bytes.size()) + " bytes can hold");
    }
  }
}

/// Line ends are those of Unix, Windows or old Macs.
bool has_line(const std::string& bytes, const std::string& line) {
  const std::string ends = "\r\n";
  for (std::size_t at = bytes.find(line, 1); at != std::string::npos;
       at = bytes.find(line, at + 1)) {
    const std::size_t end = at + line.size();
    const bool begins = ends.find(bytes[at - 1]) != std::string::npos;
    if (begins && end < bytes.size() && ends.find(bytes[end]) != std::string::npos) return true;
  }
  return false;
}

/// Requires the end of the header, which the mesh library would seek beyond the end of the file,
/// for ever.
void check_ply(const std::string& bytes, const std::string& path, const Source& source) {
  if (!has_line(bytes, "end_header")) {
    throw Error(source, "found no line 'end_header' in PLY '" + path + "', expected one");
  }
  for (const char* key : {"element vertex", "element face"}) {
    check_counts(bytes, key, path, source);
  }
}

}  // namespace

std::string mesh_file_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::size_t binary_stl_size(const std::string& bytes) {
  return is_ascii_stl(bytes) ? bytes.size() : whole_stl_size(bytes);
}

std::string check_mesh_file(const std::string& path, const Source& source) {
  static const std::set<std::string> kExtensions{".dae", ".stl", ".obj", ".ply", ".gltf", ".glb"};
  const std::string extension = mesh_file_extension(path);
  if (kExtensions.count(extension) == 0) {
    throw Error(source,
                "found mesh '" + path + "', expected a .dae, .stl, .obj, .ply, .gltf or .glb file");
  }
  const std::string bytes = read_text_file(path, source, kMaxFileBytes);
  if (bytes.empty()) throw Error(source, "found an empty mesh file '" + path + "', expected data");
  if (extension == ".stl") check_stl(bytes, path, source);
  if (extension == ".glb") check_glb(bytes, path, source);
  if (extension == ".dae") check_collada(XmlFile(bytes, path).root());
  if (extension == ".ply") check_ply(bytes, path, source);
  return bytes;
}

}  // namespace ardee
