// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <span>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm::io {

/// A pose of the path as the mapper answered it.
struct PathPose {
  Timestamp stamp{};
  UncertainPose2 map_robot;
  StepStatus status = StepStatus::kMatched;
};

Trajectory TrajectoryOf(std::span<const PathPose> path);

/// A place that was recognised: where the robot was, and where it had been before.
struct LoopLine {
  Eigen::Vector2d from_map_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_map_m = Eigen::Vector2d::Zero();
  bool is_accepted = true;
};

/// What is drawn over a map. All paths are in the frame `map`.
struct MapOverlay {
  std::vector<PathPose> path;
  Trajectory truth;       ///< The true path; empty where it is not known.
  Trajectory odometry;    ///< The path by odometry; empty where it is of no interest.
  Trajectory answered{};  ///< The path before it was corrected; empty where it was not.
  std::vector<LoopLine> loops{};
};

/// Draws the map and the robot's path over it, coloured by time, dead-reckoned poses marked, with
/// 95 % ellipses every so often; they are enlarged, as the legend says, where they would be too
/// small to see. Odometry is drawn as far as it stays on the map.
/// @throws std::invalid_argument for a name that ends in neither .png nor .svg, WriteError where
/// the
///         file cannot be written.
void WriteTrajectoryPicture(const std::filesystem::path& path,
                            const OccupancyGrid& grid,
                            const MapOverlay& overlay);

}  // namespace qwsm::io
