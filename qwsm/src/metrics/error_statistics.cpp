// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/metrics/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace qwsm {
namespace {

double SumOfSquares(const std::vector<double>& values, double about) {
  double sum = 0.0;
  for (const double value : values) sum += (value - about) * (value - about);
  return sum;
}

// The value that `share` of the values lie below, as int(share * n) counts them.
double Percentile(const std::vector<double>& sorted, double share) {
  const auto index = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(index, sorted.size() - 1)];
}

ErrorStatistics OfNothing() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {.mean = kNone,
          .standard_deviation = kNone,
          .rmse = kNone,
          .median = kNone,
          .upper_median = kNone,
          .percentile_95 = kNone,
          .min = kNone,
          .max = kNone};
}

}  // namespace

ErrorStatistics Summarize(std::vector<double> errors) {
  if (errors.empty()) return OfNothing();
  std::ranges::sort(errors);
  const auto count = static_cast<double>(errors.size());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  const double sum_of_squares = SumOfSquares(errors, 0.0);
  const double upper_median = Percentile(errors, 0.5);
  return {.count = errors.size(),
          .mean = mean,
          .standard_deviation = std::sqrt(SumOfSquares(errors, mean) / count),
          .rmse = std::sqrt(sum_of_squares / count),
          .median = std::midpoint(errors[(errors.size() - 1) / 2], upper_median),
          .upper_median = upper_median,
          .percentile_95 = Percentile(errors, 0.95),
          .min = errors.front(),
          .max = errors.back(),
          .sum_of_squares = sum_of_squares};
}

ErrorStatistics SummarizeSquares(std::vector<double> errors) {
  for (double& error : errors) error *= error;
  return Summarize(std::move(errors));
}

}  // namespace qwsm
