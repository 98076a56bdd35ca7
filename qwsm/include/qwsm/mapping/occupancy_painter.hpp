// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "qwsm/mapping/occupancy_grid.hpp"

namespace qwsm {

/// Draws an occupancy grid of scans as they come: a scan costs its beams, however many came before.
/// What it draws is what RenderOccupancyGrid() draws of the same scans. Memory is held where
/// something was seen, in square tiles, however far apart that is.
class OccupancyPainter {
 public:
  explicit OccupancyPainter(const OccupancyGridOptions& options = {}) : options_(options) {}
  OccupancyPainter(OccupancyPainter&&) = default;
  OccupancyPainter& operator=(OccupancyPainter&&) = default;
  ~OccupancyPainter() = default;

  /// Counts what the scan saw. Scans whose pose is not finite are left out.
  void Add(const RelevantScan& scan);
  /// Makes room for what lies in the box, all at once.
  void MakeRoom(const Eigen::AlignedBox2d& box_map_m);

  /// The map of all scans so far.
  OccupancyGridResult Grid() const;
  /// Memory held by the cells.
  std::size_t bytes() const { return tiles_.size() * sizeof(Tile); }

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
    std::uint16_t seen = 0;
    std::uint16_t hits = 0;
  };

  class Tile {
   public:
    static constexpr int kBits = 5;
    static constexpr int kSide = 1 << kBits;

    const Cell& At(CellIndex index) const { return cells_[Number(index)]; }
    /// A cell, the first time that a scan asks for it; null from then on.
    Cell* FirstTime(std::uint32_t scan, CellIndex index) {
      if (last_scan_ != scan) {
        last_scan_ = scan;
        asked_for_.fill(0);
      }
      const std::uint32_t column = 1U << (index.x & (kSide - 1));
      std::uint32_t& row = asked_for_[static_cast<std::size_t>(index.y & (kSide - 1))];
      if ((row & column) != 0) return nullptr;
      row |= column;
      return &cells_[Number(index)];
    }

   private:
    static std::size_t Number(CellIndex index) {
      return static_cast<std::size_t>((index.y & (kSide - 1)) * kSide + (index.x & (kSide - 1)));
    }

    std::array<Cell, std::size_t{kSide} * kSide> cells_{};
    // By the last scan, a bit for each cell of a row.
    std::array<std::uint32_t, kSide> asked_for_{};
    std::uint32_t last_scan_ = 0;
  };

  // Of the tile that holds a cell, counted from the corner of the first frame.
  static std::uint64_t Key(CellIndex index) {
    return std::uint64_t{static_cast<std::uint32_t>(index.x >> Tile::kBits)} << 32 |
           static_cast<std::uint32_t>(index.y >> Tile::kBits);
  }
  static CellIndex FirstCellOf(std::uint64_t key) {
    return {static_cast<int>(static_cast<std::uint32_t>(key >> 32)) * Tile::kSide,
            static_cast<int>(static_cast<std::uint32_t>(key)) * Tile::kSide};
  }
  void Draw(const Tile& tile, CellIndex first, OccupancyGrid& grid) const;

  bool Fits(const Eigen::AlignedBox2d& extent_m, double cell_m) const;
  double SmallestFittingCell() const;
  Frame FrameAround(const Eigen::AlignedBox2d& extent_m) const;
  void GrowTo(const Frame& grown);
  CellIndex Offset(const Frame& inner, const Frame& outer) const;
  CellIndex CellOf(const Eigen::Vector2d& p_map_m) const;
  Cell* CountSeen(CellIndex index);
  void CountHit(CellIndex index);
  void CountFreeLine(CellIndex from, CellIndex to);
  CellState StateOfCell(const Cell& cell) const;

  OccupancyGridOptions options_;
  Eigen::AlignedBox2d extent_m_;  // Of all scans so far.
  Frame frame_;                   // Of the cells: all of the extent that fits, and some more.
  Frame first_frame_;
  CellIndex at_;                                   // Of the frame in the first one.
  std::unordered_map<std::uint64_t, Tile> tiles_;  // By Key().
  std::uint64_t last_key_ = 0;
  Tile* last_tile_ = nullptr;  // Of that key: most cells are next to the last one.
  std::uint32_t scan_ = 0;
};

}  // namespace qwsm
