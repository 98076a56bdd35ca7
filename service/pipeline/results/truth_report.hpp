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
  /// Error of positions with only the first poses made to coincide.
  double ate_from_start_rmse_m = 0.0;
  /// Error of headings with only the first poses made to coincide.
  double heading_rmse_rad = 0.0;
  double loop_gap_m = 0.0;  ///< How wrong the way from the first pose to the last one is.
  NeesSummary nees;         ///< Summary of all poses but the first, which is exact by definition.
};

/// The true path in the frame `map`: the map begins where the first pose says.
Trajectory TruthInMap(std::span<const io::PathPose> path, const Trajectory& truth);

/// Compares poses with the true ones nearest in time, at most 10 ms apart.
/// @returns nothing where fewer than two have one.
std::optional<TruthReport> CompareWithTruth(std::span<const io::PathPose> path,
                                            const Trajectory& truth);

}  // namespace qwsm::pipeline
