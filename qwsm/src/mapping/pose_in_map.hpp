// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/match_result.hpp"

namespace qwsm {

/// The pose that was matched, as uncertain as the part of the map it was matched to, plus what is
/// left of its uncertainty relative to that part. Where the pairs say nothing, as along a corridor,
/// that is all of the prediction's.
///
/// @param predicted covariance of the pose predicted in the map.
/// @param motion the share of it that the motion since the last scan has.
UncertainPose2 InMap(const ScanMap& map,
                     std::span<const ScanPoint> points,
                     const Eigen::Matrix3d& predicted,
                     const Eigen::Matrix3d& motion,
                     const MatchResult& match);

/// The covariance about a pose that is right with a probability, where else another one is: the
/// second moment of the mixture of both.
Eigen::Matrix3d CovarianceOfEither(const UncertainPose2& pose,
                                   double probability,
                                   const UncertainPose2& other);

}  // namespace qwsm
