// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/io/pictures/covariance_ellipse.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "service/io/pictures/axis.hpp"

namespace qwsm::io {

Eigen::Matrix2d HalfAxes95(const Eigen::Matrix3d& covariance) {
  constexpr double kSigmas = 2.4477468306808166;  // Root of chi-square's 95 % quantile, 2 degrees.
  const Eigen::Matrix2d position_m2 = covariance.topLeftCorner<2, 2>();
  if (!position_m2.allFinite()) return Eigen::Matrix2d::Zero();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(position_m2);
  const Eigen::Vector2d deviations_m = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return kSigmas * solver.eigenvectors() * deviations_m.asDiagonal();
}

std::vector<Eigen::Vector2d> EllipseOutline(const Eigen::Vector2d& center_m,
                                            const Eigen::Matrix2d& half_axes_m) {
  constexpr int kCorners = 48;
  std::vector<Eigen::Vector2d> points_m;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kCorners;
    const Eigen::Vector2d on_circle(std::cos(angle_rad), std::sin(angle_rad));
    points_m.emplace_back(center_m + half_axes_m * on_circle);
  }
  return points_m;
}

double Enlargement(std::vector<double> radii_px) {
  constexpr double kVisible_px = 8.0;
  constexpr double kMost = 1000.0;
  if (radii_px.empty()) return 1.0;
  std::ranges::sort(radii_px);
  const double median_px = radii_px[radii_px.size() / 2];
  if (median_px >= kVisible_px) return 1.0;
  if (median_px * kMost <= kVisible_px) return kMost;
  return RoundUpToNice(kVisible_px / median_px);
}

}  // namespace qwsm::io
