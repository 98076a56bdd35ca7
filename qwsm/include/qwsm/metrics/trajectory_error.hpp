// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>
#include <span>
#include <vector>

#include "qwsm/metrics/error_statistics.hpp"
#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm {

/// A true pose and the estimate of the same moment, each in the frame of its own trajectory.
struct PosePair {
  Timestamp stamp{};  ///< Stamp of the true pose.
  Pose2 T_ref_robot;
  Pose2 T_map_robot;
};

/// Pairs every pose of the shorter trajectory with the nearest in time of the longer one (the
/// estimate counts as the shorter of two equally long), as evo does it: in the order of time, and a
/// pose of the longer may serve twice.
std::vector<PosePair> Associate(Trajectory reference,
                                Trajectory estimate,
                                std::chrono::nanoseconds max_difference);

/// Finds the T_ref_map that brings the estimated positions nearest to the true ones in the
/// least-squares sense, without scale (Umeyama 1991). For planar poses this is evo's `--align`, but
/// for one case: a mirrored trajectory, which evo is free to turn over in space, stays mirrored
/// here. Where all positions coincide, no turn is better than another and none is made. The
/// identity for no pairs.
Pose2 AlignUmeyama(std::span<const PosePair> pairs);

/// Absolute trajectory error (Sturm et al. 2012): the distances between true and estimated
/// positions after moving the estimate by T_ref_map; evo's "APE, translation part".
ErrorStatistics AbsoluteTrajectoryError(std::span<const PosePair> pairs, const Pose2& T_ref_map);

struct RelativePoseError {
  ErrorStatistics translation_m;
  ErrorStatistics rotation_rad;
};

/// Relative pose error (Sturm et al. 2012): how wrong the motion over `step` pairs is, from pair 0
/// to `step`, from `step` to 2 `step` and so on; evo's RPE with `--delta step --delta_unit f`.
/// @pre step >= 1.
RelativePoseError EvaluateRelativePoses(std::span<const PosePair> pairs, std::size_t step = 1);

}  // namespace qwsm
