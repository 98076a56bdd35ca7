// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "qwsm/matching/surface_map.hpp"

namespace qwsm {

/// Correspondence error Q of a nearest-sample match, in m^2 and map axes (Visser et al. 2009, first
/// term of Eq. (3); Pfister et al. 2002): the scan's point lies somewhere between two samples.
///
/// Along a line it is uniform over one sample spacing. Where there is no line no direction is
/// better known than another.
Eigen::Matrix2d CorrespondenceError(const Surface& surface);

/// Covariance of the error xi of a pair in Visser et al. (2009), Eq. (3): S = N_map + Q + R N R^T,
/// in m^2 and map axes. The denser the map, the smaller.
/// @param N_map noise of the scan's point in map axes, R N R^T. The map's point is taken to have
///   been measured as well as this one, and as often as scans saw its surface.
Eigen::Matrix2d NearestSampleError(const Surface& surface, const Eigen::Matrix2d& N_map);

/// Variance of the distance of a scan's point from a surface that is a line, along its normal.
/// Departing from Visser et al. (2009) and Pfister et al. (2002), such a pair tells nothing of the
/// position along the line.
///
/// @param noise_m2 of the scan's point along the normal.
/// @param inflation_m2 variance owing to the error that annealing has left of the first guess.
inline double DistanceVariance(const Surface& surface, double noise_m2, double inflation_m2) {
  return std::max(noise_m2, surface.across_m2) + noise_m2 / surface.observations + inflation_m2;
}

/// What a pair tells of the position of its scan point where the surface is no line, in 1/m^2 and
/// map axes: the inverse of its error.
///
/// @param isotropic_m2 variance of the position by the object's size, by the spacing of the beams,
///   and owing to the error that annealing has left of the first guess.
Eigen::Matrix2d PositionInformation(const Surface& surface,
                                    const Eigen::Matrix2d& N_map,
                                    double isotropic_m2);

}  // namespace qwsm
