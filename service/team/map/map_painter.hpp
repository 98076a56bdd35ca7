// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "qwsm/mapping/occupancy_painter.hpp"
#include "service/team/map/team_map.hpp"

namespace qwsm::team {

/// Draws a map that grows, at the cost of what is new in it, and without holding up those who
/// extend it. A map that was corrected is drawn anew.
class MapPainter {
 public:
  explicit MapPainter(const OccupancyGridOptions& options) : options_(options), painter_(options) {}

  /// Draws what is new in the map; gives up when asked to stop.
  void Paint(const TeamMap& map, const std::stop_token& stop);
  /// The map as drawn so far, if it can be.
  std::optional<OccupancyGrid> Grid();
  /// Whether there is more to see than in the last grid.
  bool has_news() const { return has_news_; }

  /// Stamp of the newest scan that was drawn.
  Timestamp newest() const { return newest_; }
  /// Why Grid() gave nothing the last time; empty where it gave a grid.
  const std::string& trouble() const { return trouble_; }

 private:
  void BeginAnewIfCorrected(const TeamMap& map);
  std::vector<RelevantScan> NewScansOf(const TeamMap& map) const;

  OccupancyGridOptions options_;
  OccupancyPainter painter_;
  std::size_t painted_ = 0;  // Scans drawn so far.
  std::uint32_t epoch_ = 0;  // Of the map that is drawn.
  bool has_news_ = false;
  Timestamp newest_{};
  std::string trouble_;
};

}  // namespace qwsm::team
