// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/metrics/nees.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace qwsm {
namespace {

constexpr double kDegreesOfFreedom = 3.0;
constexpr double kNormal975 = 1.959963984540054;      // 97.5 % quantile of the standard normal.
constexpr double kChiSquare3At95 = 7.81472790325118;  // 95 % quantile of chi-square, 3 degrees.

// Quantile of chi-square at `normal_quantile` of the standard normal, to 1 % from 10 degrees
// of freedom on (Wilson & Hilferty 1931).
double ChiSquareQuantile(double degrees, double normal_quantile) {
  const double spread = 2.0 / (9.0 * degrees);
  return degrees * std::pow(1.0 - spread + normal_quantile * std::sqrt(spread), 3.0);
}

NeesSummary OfTooFew(std::size_t count) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  return {.count = count,
          .mean = kNone,
          .mean_low = kNone,
          .mean_high = kNone,
          .consistent_low = kNone,
          .consistent_high = kNone,
          .share_in_95_percent_ellipsoid = kNone};
}

}  // namespace

std::optional<double> Nees(const UncertainPose2& estimate, const Pose2& truth) {
  // Scaled to unit variances, so that metres and radians do not decide what is singular.
  const Eigen::Vector3d deviation = estimate.covariance.diagonal().cwiseSqrt();
  if (!(deviation.minCoeff() > 0.0) || !deviation.allFinite()) return std::nullopt;
  const Eigen::Vector3d scale = deviation.cwiseInverse();
  const Eigen::Matrix3d correlation = scale.asDiagonal() * estimate.covariance * scale.asDiagonal();
  const Eigen::LLT<Eigen::Matrix3d> root(correlation);
  if (root.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d error = Difference(estimate.T_a_b, truth);
  return root.matrixL().solve(scale.cwiseProduct(error)).squaredNorm();
}

NeesSummary SummarizeNees(std::span<const double> values) {
  if (values.size() < 2) return OfTooFew(values.size());
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  double squared_deviations = 0.0;
  for (const double value : values) squared_deviations += (value - mean) * (value - mean);
  const double error_of_mean = std::sqrt(squared_deviations / (count - 1.0) / count);
  const auto inside = std::ranges::count_if(values, [](double v) { return v <= kChiSquare3At95; });
  const double degrees = kDegreesOfFreedom * count;
  return {.count = values.size(),
          .mean = mean,
          .mean_low = mean - kNormal975 * error_of_mean,
          .mean_high = mean + kNormal975 * error_of_mean,
          .consistent_low = ChiSquareQuantile(degrees, -kNormal975) / count,
          .consistent_high = ChiSquareQuantile(degrees, kNormal975) / count,
          .share_in_95_percent_ellipsoid = static_cast<double>(inside) / count};
}

}  // namespace qwsm
