// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "qwsm/matching/correlative_search.hpp"

namespace qwsm {

// What a squared sigma away from the prediction costs, in units of the score. The score is a mean
// over the points, so that one that misses costs 1 / points; as many as are independent count.
double CostOfSquaredSigma(std::size_t points, const CorrelativeSearchOptions& options);

// The cost of the prior: what it takes off the score of a pose to differ from the prediction.
class PriorCost {
 public:
  PriorCost(const Eigen::Matrix3d& covariance, double per_squared_sigma);

  double Of(const Eigen::Vector3d& way) const { return way.dot(information_ * way); }

  // A lower bound for the ways to a square of positions with headings from one to another.
  double AtLeast(const Eigen::Vector2d& corner_m,
                 double side_m,
                 double first_rad,
                 double last_rad) const;

 private:
  Eigen::Matrix3d information_;
  // With the heading given, the cost is least at a position in proportion to it, and grows with
  // the distance from there by least_of_position_ or more.
  Eigen::Vector2d cheapest_per_rad_;
  double of_heading_ = 0.0;
  double least_of_position_ = 0.0;
};

}  // namespace qwsm
