// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/matching/match_result.hpp"
#include "qwsm/sensor/laser_scan.hpp"

namespace qwsm {

/// How far off a guess may be of which nothing is said: standard deviations of x and y, and of the
/// heading. Searched is up to three of each, about a metre and thirty degrees.
inline constexpr double kGuessSigma_m = 0.3;
inline constexpr double kGuessSigma_rad = 0.17;

/// Where `scan` was taken, seen from where `reference` was: weighted matching of two scans (Pfister
/// et al. 2002) after a search around the guess. All options are at their defaults; with options,
/// or against the map of many scans, ScanLocator does the same.
///
/// @param reference, scan from the same laser or from different ones, on the same robot or on two.
///        Poses are those of the robots, which the scans' `geometry.T_robot_laser` leads to.
/// @param guess of the robot's pose at `scan` in the robot's frame at `reference`, in metres and
///        radians, with its covariance. It is fused with what the scans say: where they leave a
///        direction open, as along a corridor, the guess stands.
/// @pre the covariance of the guess is positive definite; else the result is kDegenerate.
/// @return the pose as `T_ref_cur` with its covariance of (x, y, theta) in m^2, m rad and rad^2. It
///         is to be trusted where `status` is kConverged: scans with nothing in common are
///         kTooFewPairs or kInconsistent.
MatchResult MatchScans(const LaserScan& reference,
                       const LaserScan& scan,
                       const UncertainPose2& guess);

/// Where `scan` was taken, seen from where `reference` was, with a guess that is off by as much as
/// kGuessSigma_m and kGuessSigma_rad say; without one, that the robot has hardly moved.
MatchResult MatchScans(const LaserScan& reference,
                       const LaserScan& scan,
                       const Pose2& T_ref_cur_guess = {});

}  // namespace qwsm
