// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map_painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace qwsm::team {

std::optional<OccupancyGrid> MapPainter::Paint(const TeamMap& map) {
  if (!CopyNewScans(map)) return std::nullopt;
  OccupancyGridResult result = RenderOccupancyGrid(scans_, options_);
  trouble_.clear();
  if (result.status == RenderStatus::kRendered) return std::move(result.grid);
  if (result.status == RenderStatus::kTooLarge) {
    trouble_ =
        fmt::format("the map of {:.0f} x {:.0f} m is too large to be drawn with cells of {} m",
                    result.extent_x_m,
                    result.extent_y_m,
                    options_.cell_m);
  }
  return std::nullopt;
}

bool MapPainter::CopyNewScans(const TeamMap& map) {
  const TeamMap::State::View view = map.Read();
  const std::span<const RelevantScan> scans = view->scans();
  if (scans.size() == scans_.size()) return false;
  for (const RelevantScan& scan : scans.subspan(scans_.size())) {
    newest_ = std::max(newest_, scan.scan.stamp);
    scans_.push_back(scan);
  }
  return true;
}

}  // namespace qwsm::team
