// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "qwsm/mapping/occupancy_painter.hpp"
#include "service/team/team_map.hpp"

namespace qwsm::team {

/// Draws a map that grows, at the cost of what is new in it, and without holding up those who
/// extend it.
class MapPainter {
 public:
  explicit MapPainter(const OccupancyGridOptions& options)
      : cell_m_(options.cell_m), painter_(options) {}

  /// The map, if there is anything new in it that can be drawn. Given up when asked to stop.
  std::optional<OccupancyGrid> Paint(const TeamMap& map, const std::stop_token& stop);

  /// Stamp of the newest scan that was drawn.
  Timestamp newest() const { return newest_; }
  /// Why the last map was not drawn; empty where it was.
  const std::string& trouble() const { return trouble_; }

 private:
  std::vector<RelevantScan> NewScansOf(const TeamMap& map) const;

  double cell_m_;
  OccupancyPainter painter_;
  std::size_t painted_ = 0;  // Scans.
  Timestamp newest_{};
  std::string trouble_;
};

}  // namespace qwsm::team
