// SPDX-License-Identifier: MIT
#include "ardee_sim/core/text_file.h"

#include <filesystem>
#include <fstream>

namespace ardee {

std::string read_text_file(const std::string& path, const Source& source, std::size_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) {
    throw Error(source, "found no file '" + path + "', expected a readable file");
  }
  const auto size = std::filesystem::file_size(path, error);
  if (error || size > max_bytes) {
    throw Error(source, "found " + std::to_string(size) + " bytes in '" + path +
                            "', expected at most " + std::to_string(max_bytes));
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text(size, '\0');
  if (!stream || !stream.read(text.data(), static_cast<std::streamsize>(size))) {
    throw Error(source, "cannot read '" + path + "', expected a readable file");
  }
  return text;
}

std::string folder_of(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

}  // namespace ardee
