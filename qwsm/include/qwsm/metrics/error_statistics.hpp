// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace qwsm {

/// What a set of error magnitudes looks like, in the unit of the errors. All but `count` and
/// `sum_of_squares` are NaN where there are none.
struct ErrorStatistics {
  std::size_t count = 0;
  double mean = 0.0;
  double standard_deviation = 0.0;  ///< That of a population: divided by the count.
  double rmse = 0.0;
  double median = 0.0;         ///< The mean of the two middle values where the count is even.
  double upper_median = 0.0;   ///< The larger of the two middle values where the count is even.
  double percentile_95 = 0.0;  ///< The first value, in rising order, with 95 % of all below it.
  double min = 0.0;
  double max = 0.0;
  double sum_of_squares = 0.0;
};

/// Summarises error magnitudes in O(n log n).
ErrorStatistics Summarize(std::vector<double> errors);

/// Summarises the squares of error magnitudes.
ErrorStatistics SummarizeSquares(std::vector<double> errors);

}  // namespace qwsm
