// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/map/map_painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace qwsm::team {

void MapPainter::Paint(const TeamMap& map, const std::stop_token& stop) {
  BeginAnewIfCorrected(map);
  for (const RelevantScan& scan : NewScansOf(map)) {
    if (stop.stop_requested()) return;
    painter_.Add(scan);
    newest_ = std::max(newest_, scan.scan.stamp);
    ++painted_;
    has_news_ = true;
  }
}

std::optional<OccupancyGrid> MapPainter::Grid() {
  OccupancyGridResult result = painter_.Grid();
  trouble_.clear();
  has_news_ = false;
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

// What is told until all is drawn is the map as it was.
void MapPainter::BeginAnewIfCorrected(const TeamMap& map) {
  const std::uint32_t epoch = map.Read()->epoch;
  if (epoch == epoch_) return;
  painter_ = OccupancyPainter(options_);
  painted_ = 0;
  epoch_ = epoch;
}

// A copy: whoever reads the map for long holds up those who extend it.
std::vector<RelevantScan> MapPainter::NewScansOf(const TeamMap& map) const {
  const TeamMap::State::View view = map.Read();
  if (view->epoch != epoch_) return {};
  const std::span<const RelevantScan> scans = view->map.scans().subspan(painted_);
  return {scans.begin(), scans.end()};
}

}  // namespace qwsm::team
