// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "qwsm/mapping/occupancy_grid.hpp"

namespace qwsm::io {

/// Draws the map, with a scale below. The file is a PNG or an SVG, as its name ends.
/// @throws std::invalid_argument for another ending, WriteError where it cannot be written.
void WriteMapPicture(const std::filesystem::path& path, const OccupancyGrid& grid);

}  // namespace qwsm::io
