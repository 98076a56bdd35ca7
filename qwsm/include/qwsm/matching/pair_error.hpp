// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "qwsm/matching/surface_map.hpp"

namespace qwsm {

/// Correspondence error Q of a nearest-sample match, in m^2 and map axes (Pfister et al. 2002).
///
/// Along a line it is uniform over one sample spacing. Where there is no line no direction is
/// better known than another.
Eigen::Matrix2d CorrespondenceError(const Surface& surface);

/// Error of a pair as the papers model it (Visser et al. 2009, eq. 3), S = N_map + Q + R N R^T, in
/// m^2 and map axes. The denser the map, the smaller.
/// @param N_map noise of the scan's point in map axes; the map's point is taken to have been
///   measured as well as this one, and as often as the surface was looked at.
Eigen::Matrix2d NearestSampleError(const Surface& surface, const Eigen::Matrix2d& N_map);

/// What a pair tells of the position of its scan point, in 1/m^2 and map axes: the inverse of its
/// error. Departing from the papers, a line tells nothing of the position along it.
///
/// @param extent_m2 variance of the position of an object that is no line, by its size and by the
///   spacing of the beams.
/// @param doubt_m2 variance owing to the pose not being known yet.
Eigen::Matrix2d PairInformation(const Surface& surface,
                                const Eigen::Matrix2d& N_map,
                                double extent_m2,
                                double doubt_m2);

}  // namespace qwsm
