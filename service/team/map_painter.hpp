// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"
#include "service/team/team_map.hpp"

namespace qwsm::team {

/// Draws a map that grows, without holding up those who extend it.
class MapPainter {
 public:
  explicit MapPainter(const OccupancyGridOptions& options) : options_(options) {}

  /// The map, if there is anything new in it that can be drawn.
  std::optional<OccupancyGrid> Paint(const TeamMap& map);

  /// Stamp of the newest scan that was drawn.
  Timestamp newest() const { return newest_; }
  /// Why the last map was not drawn; empty where it was.
  const std::string& trouble() const { return trouble_; }

 private:
  bool CopyNewScans(const TeamMap& map);

  OccupancyGridOptions options_;
  std::vector<RelevantScan> scans_;
  Timestamp newest_{};
  std::string trouble_;
};

}  // namespace qwsm::team
