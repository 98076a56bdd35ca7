// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "qwsm/metrics/stamped_pose.hpp"

namespace qwsm::io {

/// The path of one of several robots, in the frame `map`.
struct RobotPath {
  std::string robot;
  Trajectory path;
};

/// Draws the map and over it the path of each robot in a colour of its own, with its name in the
/// legend; after so many as there are colours they come again, dashed. Who has no path is left out,
/// and one robot alone is no team: the map is as WriteMapPicture() draws it.
/// @throws std::invalid_argument for a name that ends in neither .png nor .svg, WriteError where
/// the file cannot be written.
void WriteTeamPicture(const std::filesystem::path& path,
                      const OccupancyGrid& grid,
                      std::span<const RobotPath> robots);

}  // namespace qwsm::io
