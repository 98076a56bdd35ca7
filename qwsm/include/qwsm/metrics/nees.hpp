// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Normalised estimation error squared of one estimate, e^T C^-1 e with e = estimate - truth in
/// (x, y, theta) and the heading wrapped (Bar-Shalom et al. 2001, section 5.4). Its expectation is
/// 3 when the covariance tells the truth, more when it is too small. None where the covariance is
/// not positive definite.
std::optional<double> Nees(const UncertainPose2& estimate, const Pose2& truth);

struct NeesSummary {
  std::size_t count = 0;
  double mean = 0.0;
  /// 95 % confidence interval of the mean, from the spread of the values themselves.
  double mean_low = 0.0;
  double mean_high = 0.0;
  /// Where the mean of as many values lies in 95 % of the cases if the covariances are right and
  /// the errors independent: the chi-square test of Bar-Shalom et al. (2001), Eq. (5.4.2-10).
  double consistent_low = 0.0;
  double consistent_high = 0.0;
  /// Share of the values within the ellipsoid of 95 %; 0.95 when the covariances are right.
  double share_in_95_percent_ellipsoid = 0.0;
};

/// Summarises NEES values. All but the count are NaN for fewer than two of them.
NeesSummary SummarizeNees(std::span<const double> values);

}  // namespace qwsm
