// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/pair_error.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace qwsm {

Eigen::Matrix2d CorrespondenceError(const Surface& surface) {
  const double along_m2 = UniformVariance(surface.spacing_m);
  if (!surface.is_line) return along_m2 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d tangent(-surface.normal.y(), surface.normal.x());
  return along_m2 * tangent * tangent.transpose();
}

Eigen::Matrix2d NearestSampleError(const Surface& surface, const Eigen::Matrix2d& N_map) {
  return N_map / surface.looks + CorrespondenceError(surface) + N_map;
}

Eigen::Matrix2d PairInformation(const Surface& surface,
                                const Eigen::Matrix2d& N_map,
                                double extent_m2,
                                double doubt_m2) {
  if (surface.is_line) {
    const Eigen::Vector2d& n = surface.normal;
    const double noise_m2 = n.dot(N_map * n);
    const double variance_m2 =
        std::max(noise_m2, surface.across_m2) + noise_m2 / surface.looks + doubt_m2;
    return n * n.transpose() / variance_m2;
  }
  const double isotropic_m2 = surface.across_m2 + extent_m2 + doubt_m2;
  return (NearestSampleError(surface, N_map) + isotropic_m2 * Eigen::Matrix2d::Identity())
      .inverse();
}

}  // namespace qwsm
