// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/fuel_cache.h"

#include <algorithm>
#include <cctype>

#include "ardee_sim/description/parameters.h"

namespace ardee {
namespace fs = std::filesystem;
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Addresses write a space in a name as %20.
std::string with_spaces(std::string text) {
  const std::string code = "%20";
  for (std::size_t at = text.find(code); at != std::string::npos; at = text.find(code, at)) {
    text.replace(at, code.size(), " ");
  }
  return text;
}

/// The folder of the newest version of a model; empty if there is none.
fs::path newest_version(const fs::path& model) {
  double newest = 0.0;
  fs::path found;
  std::error_code error;
  for (fs::directory_iterator it(model, error), end; !error && it != end; it.increment(error)) {
    const auto version = to_double(it->path().filename().string());
    if (version && *version > newest) {
      newest = *version;
      found = it->path();
    }
  }
  return found;
}

}  // namespace

std::vector<fs::path> places_in_fuel_cache(const fs::path& cache, const std::string& address) {
  const fs::path written(with_spaces(address));
  const std::vector<fs::path> parts(written.begin(), written.end());
  // The version of the server's interface stands between server and owner.
  const auto kind = std::find(parts.begin(), parts.end(), "models");
  if (kind - parts.begin() < 2 || parts.end() - kind < 2) return {};
  const std::string owner = *(kind - 1);
  const std::string name = lower(*(kind + 1));
  const std::string version = parts.end() - kind > 2 ? *(kind + 2) : fs::path();
  fs::path file;
  for (auto part = kind + 3; part < parts.end(); ++part) {
    if (part > kind + 3 || *part != "files") file /= *part;
  }
  std::vector<fs::path> places;
  for (const std::string& each : {owner, lower(owner)}) {
    const fs::path model = cache / parts.front() / each / "models" / name;
    const bool any = version.empty() || version == "tip";
    const fs::path folder = any ? newest_version(model) : model / version;
    if (!folder.empty()) places.push_back(file.empty() ? folder : folder / file);
  }
  return places;
}

}  // namespace ardee
