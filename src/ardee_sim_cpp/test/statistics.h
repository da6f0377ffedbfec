// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace ardee {

/// Number of standard errors that bounds of tests allow: a right model fails one test in 15,000
/// (and, as all streams are seeded, either always or never).
constexpr double kFourSigma = 4.0;

inline double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

inline double std_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// Returns the autocorrelation at a lag, about a mean of zero.
inline double correlation_at(const std::vector<double>& values, std::size_t lag) {
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) squares += values[i] * values[i];
  for (std::size_t i = lag; i < values.size(); ++i) products += values[i] * values[i - lag];
  return products / squares * static_cast<double>(values.size()) /
         static_cast<double>(values.size() - lag);
}

/// Returns the Allan deviation of samples of a rate at an averaging time of `window` samples, from
/// overlapping windows (IEEE Std 952-1997, annex C).
inline double allan_deviation(const std::vector<double>& values, std::size_t window) {
  std::vector<double> sums(values.size() + 1, 0.0);
  std::partial_sum(values.begin(), values.end(), sums.begin() + 1);
  double total = 0.0;
  const std::size_t count = values.size() - 2 * window + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double step =
        (sums[i + 2 * window] - 2.0 * sums[i + window] + sums[i]) / static_cast<double>(window);
    total += step * step;
  }
  return std::sqrt(0.5 * total / static_cast<double>(count));
}

}  // namespace ardee
