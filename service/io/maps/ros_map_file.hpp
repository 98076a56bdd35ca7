// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "qwsm/mapping/occupancy_grid.hpp"

namespace qwsm::io {

/// Writes a map as ROS's map_server reads it: `path`, a YAML file, and beside it the picture it
/// names, with the ending .pgm. Free cells are 254, occupied ones 0, unknown ones 205; the
/// thresholds stand between these greys, so that all three come back.
/// @throws WriteError.
void WriteRosMap(const std::filesystem::path& path, const OccupancyGrid& grid);

/// Reads a map of ROS's map_server, also from other programs' files, as its mode `trinary` does.
/// @throws std::runtime_error naming the file, and the line or key, where it is no such map.
OccupancyGrid ReadRosMap(const std::filesystem::path& path);

}  // namespace qwsm::io
