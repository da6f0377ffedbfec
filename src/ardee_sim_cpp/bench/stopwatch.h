// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <ctime>
#include <string>
#include <vector>

namespace ardee::bench {

/// Wall time since construction or the last restart.
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

/// Processor time of all threads of this process since construction or the last restart; other work
/// on the machine hardly changes it.
class CpuStopwatch {
 public:
  double elapsed_s() const {
    return static_cast<double>(std::clock() - start_) / static_cast<double>(CLOCKS_PER_SEC);
  }
  double restart() {
    const double elapsed = elapsed_s();
    start_ = std::clock();
    return elapsed;
  }

 private:
  std::clock_t start_ = std::clock();
};

/// Returns the value below which a share of the values lies; 0 without values.
double percentile(std::vector<double> values, double share);
double median(const std::vector<double>& values);

/// Returns a figure of this process in /proc/self/status, such as VmRSS or VmHWM (the greatest so
/// far).
double memory_mb(const std::string& key);

}  // namespace ardee::bench
