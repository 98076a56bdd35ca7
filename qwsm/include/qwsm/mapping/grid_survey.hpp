// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "qwsm/mapping/occupancy_grid.hpp"
#include "qwsm/mapping/scan_map.hpp"

namespace qwsm {

/// A map of scans that a laser would have taken in an occupancy grid, as other programs make them:
/// to localize in it. The laser is put wherever an occupied cell is in view that no scan has yet
/// shown well. A surface lies where the occupied cells around have their line, and is known to half
/// a cell.
/// Complexity: linear in the surface's cells, times the cells along the beams of a scan.
/// @return an empty map where no occupied cell is beside a free one.
ScanMap SurveyGrid(const OccupancyGrid& grid, const ScanMapOptions& options = {});

}  // namespace qwsm
