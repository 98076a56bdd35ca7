// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/matching/match_result.hpp"

namespace qwsm {

/// A pose that was matched.
struct PoseInMap {
  UncertainPose2 map_robot;
  double sigma_m;  ///< How far off the surfaces that it was matched with were predicted.
};

/// The pose that was matched, as uncertain as the part of the map it was matched to, plus what is
/// left of its uncertainty relative to that part. Where the pairs say nothing, as along a corridor,
/// that is all of the prediction's.
///
/// @param predicted covariance of the pose predicted in the map.
/// @param motion the share of it that the motion since the last scan has.
PoseInMap InMap(const ScanMap& map,
                std::span<const ScanPoint> points,
                const Eigen::Matrix3d& predicted,
                const Eigen::Matrix3d& motion,
                const MatchResult& match);

/// How probable it is that a scan was taken where it was matched and at no other pose that the
/// prediction allows. Not at all where it tells too little: a robot that has gathered drift may be
/// anywhere, and the few points that it sees are not those of a surface which the map had before.
/// @param sigma_m how far off the surfaces were predicted.
double ProbabilityOfPose(const ScanMap& map,
                         std::span<const ScanPoint> points,
                         const MatchResult& match,
                         double sigma_m);

/// The covariance about a pose that is right with a probability, where else another one is: the
/// second moment of the mixture of both.
Eigen::Matrix3d CovarianceOfEither(const UncertainPose2& pose,
                                   double probability,
                                   const UncertainPose2& other);

}  // namespace qwsm
