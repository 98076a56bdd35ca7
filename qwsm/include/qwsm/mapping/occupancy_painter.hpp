// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "qwsm/mapping/occupancy_grid.hpp"

namespace qwsm {

/// Draws an occupancy grid of scans as they come: a scan costs its beams, however many came before.
/// What it draws is what RenderOccupancyGrid() draws of the same scans.
class OccupancyPainter {
 public:
  explicit OccupancyPainter(const OccupancyGridOptions& options = {}) : options_(options) {}

  /// Counts what the scan saw. Scans whose pose is not finite are left out.
  void Add(const RelevantScan& scan);
  /// Makes room for what lies in the box, all at once.
  void MakeRoom(const Eigen::AlignedBox2d& box_map_m);

  /// The map of all scans so far.
  OccupancyGridResult Grid() const;

  /// What a scan measured, the laser included; empty if nothing.
  static Eigen::AlignedBox2d ExtentOf(const RelevantScan& scan,
                                      const OccupancyGridOptions& options);

 private:
  // Cells from a corner on, on the lattice of whole cells, so that maps of one run lie on each
  // other cell by cell.
  struct Frame {
    Eigen::Vector2d origin_map_m = Eigen::Vector2d::Zero();
    int width = 0;
    int height = 0;
  };
  struct CellIndex {
    int x = 0;
    int y = 0;
  };
  struct Cell {
    std::uint32_t last_scan = 0;
    std::uint16_t seen = 0;
    std::uint16_t hits = 0;
  };

  bool Fits(const Eigen::AlignedBox2d& extent_m, double cell_m) const;
  double SmallestFittingCell() const;
  Frame FrameAround(const Eigen::AlignedBox2d& extent_m) const;
  void GrowTo(const Frame& grown);
  CellIndex Offset(const Frame& inner, const Frame& outer) const;
  CellIndex CellOf(const Eigen::Vector2d& p_map_m) const;
  Cell& At(CellIndex index);
  bool CountSeen(Cell& cell);
  void CountHit(CellIndex index);
  void CountFreeLine(CellIndex from, CellIndex to);
  CellState StateOfCell(const Cell& cell) const;

  OccupancyGridOptions options_;
  Eigen::AlignedBox2d extent_m_;  // Of all scans so far.
  Frame frame_;                   // Of the cells: all of the extent that fits, and some more.
  std::vector<Cell> cells_;
  std::uint32_t scan_ = 0;
};

}  // namespace qwsm
