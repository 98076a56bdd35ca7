// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "prior_cost.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace qwsm {
namespace {

double DistanceToInterval(double value, double low, double high) {
  return std::max({0.0, low - value, value - high});
}

}  // namespace

double CostOfSquaredSigma(std::size_t points, const CorrelativeSearchOptions& options) {
  const auto independent = static_cast<std::size_t>(options.independent_points);
  return options.prior_cost_points / static_cast<double>(std::min(points, independent));
}

PriorCost::PriorCost(const Eigen::Matrix3d& covariance, double per_squared_sigma)
    : information_(per_squared_sigma * covariance.inverse()) {
  const Eigen::Matrix2d of_position = information_.topLeftCorner<2, 2>();
  const Eigen::Vector2d cross = information_.topRightCorner<2, 1>();
  cheapest_per_rad_ = -of_position.inverse() * cross;
  of_heading_ = information_(2, 2) + cross.dot(cheapest_per_rad_);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
  axes.computeDirect(of_position, Eigen::EigenvaluesOnly);
  least_of_position_ = std::max(0.0, axes.eigenvalues()(0));
}

double PriorCost::AtLeast(const Eigen::Vector2d& corner_m,
                          double side_m,
                          double first_rad,
                          double last_rad) const {
  const Eigen::Vector2d first_m = first_rad * cheapest_per_rad_;
  const Eigen::Vector2d last_m = last_rad * cheapest_per_rad_;
  const Eigen::Vector2d low_m = corner_m - first_m.cwiseMax(last_m);
  const Eigen::Vector2d high_m = corner_m - first_m.cwiseMin(last_m);
  const double x_m = DistanceToInterval(0.0, low_m.x(), high_m.x() + side_m);
  const double y_m = DistanceToInterval(0.0, low_m.y(), high_m.y() + side_m);
  const double turn_rad = DistanceToInterval(0.0, first_rad, last_rad);
  return of_heading_ * turn_rad * turn_rad + least_of_position_ * (x_m * x_m + y_m * y_m);
}

}  // namespace qwsm
