// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_file_check.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "ardee_sim/readers/collada_check.h"
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

/// The mesh library looks for the end of a header beyond the end of the file, for ever.
void check_ply(const std::string& bytes, const std::string& path, const Source& source) {
  if (!has_line(bytes, "end_header")) {
    throw Error(source, "found no line 'end_header' in PLY '" + path + "', expected one");
  }
  for (const char* key : {"element vertex", "element face"}) {
    check_counts(bytes, key, path, source);
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
  if (extension == ".dae") check_collada(XmlFile(bytes, path).root());
  if (extension == ".ply") check_ply(bytes, path, source);
}

}  // namespace ardee
