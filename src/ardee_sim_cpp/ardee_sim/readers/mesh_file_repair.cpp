// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/mesh_file_repair.h"

#include <cctype>

#include "ardee_sim/readers/collada_fans.h"
#include "ardee_sim/readers/mesh_file_check.h"
#include "ardee_sim/readers/xml_text.h"

namespace ardee {
namespace {

/// Whether a number begins with the point at `at`, or with the sign before it.
bool begins_number(const std::string& text, std::size_t at) {
  if (at + 1 == text.size() || !std::isdigit(static_cast<unsigned char>(text[at + 1]))) {
    return false;
  }
  if (at > 0 && (text[at - 1] == '-' || text[at - 1] == '+')) --at;
  return at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t');
}

/// .5 becomes 0.5.
std::string with_leading_zeros(const std::string& text) {
  std::string made;
  made.reserve(text.size());
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '.' && begins_number(text, at)) made += '0';
    made += text[at];
  }
  return made;
}

}  // namespace

std::string repair_mesh_file(std::string bytes, const std::string& path, const Source& source,
                             Log& log) {
  const std::string extension = mesh_file_extension(path);
  if (extension == ".obj") return with_leading_zeros(bytes);
  if (extension == ".dae" && bytes.find("<trifans") != std::string::npos) {
    return fans_to_triangles(plain_xml(bytes, path), path);
  }
  if (extension == ".stl") {
    const std::size_t size = binary_stl_size(bytes);
    if (size < bytes.size()) {
      log.warn(source.to_string() + ": found " + std::to_string(bytes.size() - size) +
               " bytes after the last triangle of '" + path + "', expected none; left out");
      bytes.resize(size);
    }
  }
  return bytes;
}

}  // namespace ardee
