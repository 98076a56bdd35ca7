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

double PriorCost::AtLeast(const Eigen::Vector2d& corner_m, double side_m, double turn_rad) const {
  const Eigen::Vector2d cheapest_m = turn_rad * cheapest_per_rad_;
  const double x_m = DistanceToInterval(cheapest_m.x(), corner_m.x(), corner_m.x() + side_m);
  const double y_m = DistanceToInterval(cheapest_m.y(), corner_m.y(), corner_m.y() + side_m);
  return of_heading_ * turn_rad * turn_rad + least_of_position_ * (x_m * x_m + y_m * y_m);
}

}  // namespace qwsm
