// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/pair_error.hpp"

#include <Eigen/LU>

namespace qwsm {

Eigen::Matrix2d CorrespondenceError(const Surface& surface) {
  if (!surface.is_line) return surface.sampling_m2 * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d tangent(-surface.normal.y(), surface.normal.x());
  return surface.sampling_m2 * tangent * tangent.transpose();
}

Eigen::Matrix2d NearestSampleError(const Surface& surface, const Eigen::Matrix2d& N_map) {
  // Visser et al. (2009), Eq. (3): measurement error of the map's point, correspondence error, and
  // measurement error of the scan's point. The mean of several readings is better than one.
  return N_map / surface.observations + CorrespondenceError(surface) + N_map;
}

Eigen::Matrix2d PositionInformation(const Surface& surface,
                                    const Eigen::Matrix2d& N_map,
                                    double isotropic_m2) {
  const Eigen::Matrix2d isotropic =
      (surface.across_m2 + isotropic_m2) * Eigen::Matrix2d::Identity();
  return (NearestSampleError(surface, N_map) + isotropic).inverse();
}

}  // namespace qwsm
