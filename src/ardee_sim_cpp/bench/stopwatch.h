// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace ardee::bench {

/// Wall time since it was made or restarted.
class Stopwatch {
 public:
  double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  double restart() {
    const double elapsed = elapsed_s();
    start_ = std::chrono::steady_clock::now();
    return elapsed;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The value below which a share of the values lies; 0 of none.
inline double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

inline double median(const std::vector<double>& values) { return percentile(values, 0.5); }

/// A figure of this process in /proc/self/status, such as VmRSS or VmHWM (the most that it ever
/// held).
inline double memory_mb(const std::string& key) {
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
