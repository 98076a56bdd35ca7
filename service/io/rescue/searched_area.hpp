// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"
#include "qwsm/mapping/occupancy_grid.hpp"

namespace qwsm::io {

/// Looks at a cell that count: who has looked at it that often has searched it well.
inline constexpr int kMostLooks = 4;

/// From how many places of the paths, 0.25 m apart, each free cell was in sight within a radius, as
/// by a sensor for victims that looks all around; at most kMostLooks. Row by row, as the grid.
/// O(length of the paths x area of the circle).
std::vector<std::uint8_t> LooksAtCells(const OccupancyGrid& grid,
                                       std::span<const std::vector<Pose2>> paths,
                                       double radius_m);

}  // namespace qwsm::io
