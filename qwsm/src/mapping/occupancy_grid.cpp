// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/occupancy_grid.hpp"

#include "qwsm/mapping/occupancy_painter.hpp"

namespace qwsm {

OccupancyGridResult RenderOccupancyGrid(std::span<const RelevantScan> scans,
                                        const OccupancyGridOptions& options) {
  Eigen::AlignedBox2d extent_m;
  for (const RelevantScan& scan : scans) {
    extent_m.extend(OccupancyPainter::ExtentOf(scan, options));
  }
  OccupancyPainter painter(options);
  if (!extent_m.isEmpty()) painter.MakeRoom(extent_m);
  for (const RelevantScan& scan : scans) painter.Add(scan);
  return painter.Grid();
}

}  // namespace qwsm
