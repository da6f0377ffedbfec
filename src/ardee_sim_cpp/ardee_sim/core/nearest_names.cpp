// SPDX-License-Identifier: MIT
#include "ardee_sim/core/nearest_names.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace ardee {
namespace {

constexpr std::size_t kNamesShown = 5;
constexpr std::size_t kLettersCompared = 100;
constexpr std::size_t kTellingLetters = 3;  // a letter or two are a part of many names

std::string comparable(const std::string& name) {
  std::string text = name.substr(0, kLettersCompared);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// Returns 0 to 1 by the edit distance, 1 more if one name is a part of the other, and 2 more if
/// one begins the other.
double likeness(const std::string& one, const std::string& two) {
  const auto& [shorter, longer] =
      std::minmax(one, two, [](const auto& a, const auto& b) { return a.size() < b.size(); });
  double score = 1.0 - static_cast<double>(edit_distance(one, two)) /
                           static_cast<double>(std::max<std::size_t>(longer.size(), 1));
  if (shorter.size() >= kTellingLetters) {
    const std::size_t at = longer.find(shorter);
    score += at == std::string::npos ? 0.0 : (at == 0 ? 2.0 : 1.0);
  }
  return score;
}

}  // namespace

std::size_t edit_distance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> costs(to.size() + 1);  // from the letters of `from` seen so far
  std::iota(costs.begin(), costs.end(), 0);
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = costs[0]++;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = costs[j + 1];
      costs[j + 1] = std::min({replaced, diagonal + 1, costs[j] + 1});
    }
  }
  return costs.back();
}

std::string nearest_names(const std::string& name, const std::vector<std::string>& known) {
  if (known.empty()) return "none";
  std::vector<std::pair<double, const std::string*>> ranked;
  const std::string wrong = comparable(name);
  for (const std::string& each : known)
    ranked.emplace_back(-likeness(wrong, comparable(each)), &each);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string text;
  for (std::size_t i = 0; i < std::min(ranked.size(), kNamesShown); ++i) {
    text += (i == 0 ? "" : ", ") + *ranked[i].second;
  }
  if (ranked.size() > kNamesShown) text += ", ... (" + std::to_string(ranked.size()) + " in all)";
  return text;
}

}  // namespace ardee
