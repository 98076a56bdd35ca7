// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "qwsm/metrics/nees.hpp"
#include "qwsm/metrics/stamped_pose.hpp"
#include "service/io/pictures/trajectory_picture.hpp"

namespace qwsm::pipeline {

/// How far a path is from the truth.
struct TruthReport {
  std::size_t poses = 0;
  double ate_rmse_m = 0.0;  ///< Error of positions, after the best alignment (Sturm et al. 2012).
  /// Error of positions in the frame `map`, where that lies as its first robot began.
  double ate_from_start_rmse_m = 0.0;
  double heading_rmse_rad = 0.0;  ///< Error of headings, likewise.
  double loop_gap_m = 0.0;        ///< How wrong the way from the first pose to the last one is.
  NeesSummary nees;  ///< Summary of all poses but the first, which is exact by definition.
};

/// Where the frame `map` lies in the world of the truth, if the first pose is right that has one.
std::optional<Pose2> TrueMapInWorld(std::span<const io::PathPose> path, const Trajectory& truth);

/// The true path in the frame `map`, in the order of time.
Trajectory TruthInMap(const Trajectory& truth, const Pose2& T_world_map);

/// Compares poses with the true ones nearest in time, at most 10 ms apart.
/// @pre `truth_in_map` is sorted by stamp
/// @returns nothing where fewer than two have one.
std::optional<TruthReport> CompareWithTruth(std::span<const io::PathPose> path,
                                            const Trajectory& truth_in_map);

}  // namespace qwsm::pipeline
