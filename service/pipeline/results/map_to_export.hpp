// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"
#include "qwsm/mapping/relevant_scan.hpp"
#include "qwsm/sensor/laser_scan.hpp"
#include "service/io/rescue/points_of_interest.hpp"

namespace qwsm::pipeline {

/// A map, and how the robots went through it; all of it is in the frame `map`.
struct MapToExport {
  OccupancyGrid grid;
  std::vector<std::vector<Pose2>> paths;     ///< Path of each robot, from its start.
  std::optional<Timestamp> start;            ///< Stamp of the first pose, where it is known.
  std::vector<io::PointOfInterest> marks{};  ///< What operators marked.
};

/// A relevant scan, and who took it.
struct RobotScan {
  std::string robot;
  RelevantScan relevant;
};

/// The map of scans that robots took, each robot's in their order; paths go from scan to scan.
/// @param name stands for where they came from in messages.
/// @throws std::runtime_error where no map can be drawn of them.
MapToExport MapOfScans(const std::vector<RobotScan>& scans,
                       const std::string& name,
                       const OccupancyGridOptions& rendering);

/// Reads a map wherever one was left: in the folder of results of `map`, `localize` or `serve`, as
/// the YAML file of ROS's map_server, in the journal of a service, or saved by `map --save-map`.
/// Marks are in journals, in maps that were saved, and in folders that `serve` or `map` left. Paths
/// out of journals and saved maps go through the relevant scans. Entries of a journal that are
/// damaged are warned of and left out.
/// @param rendering for what is not rendered yet.
/// @throws std::runtime_error naming the file, what is wrong and what would be right.
MapToExport LoadMapToExport(const std::filesystem::path& source,
                            const OccupancyGridOptions& rendering);

}  // namespace qwsm::pipeline
