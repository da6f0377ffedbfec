// SPDX-License-Identifier: MIT
#include "bench/stopwatch.h"

#include <algorithm>
#include <cstddef>
#include <fstream>

namespace ardee::bench {

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

double median(const std::vector<double>& values) { return percentile(values, 0.5); }

double memory_mb(const std::string& key) {
  constexpr double kMegabytesPerKibibyte = 1024.0 / 1e6;
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    double kibibytes = 0.0;
    if (word == key + ":" && status >> kibibytes) return kibibytes * kMegabytesPerKibibyte;
  }
  return 0.0;
}

}  // namespace ardee::bench
