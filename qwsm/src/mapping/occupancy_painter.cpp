// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/occupancy_painter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace qwsm {
namespace {

// Free cells around what was measured, so that no wall lies on the border.
constexpr int kMarginCells = 4;

// Room to spare on every side when the map grows, as a share of its size.
constexpr double kSpareShare = 0.25;

// From the origin of the map: further away a double does not tell cells apart safely.
constexpr double kFurthestCell = 1e12;

// How far a reading says that the way is free, and whether there is a surface at the end.
struct Sight {
  double range_m = 0.0;
  bool hit = false;
};

std::optional<Sight> SightOf(float range_m,
                             const LaserGeometry& geometry,
                             const OccupancyGridOptions& options) {
  const double reading_m = static_cast<double>(range_m);
  switch (StateOf(range_m, geometry)) {
    case BeamState::kHit:
      if (reading_m <= options.usable_range_m) return Sight{.range_m = reading_m, .hit = true};
      return Sight{.range_m = options.usable_range_m, .hit = false};
    case BeamState::kMiss:
      return Sight{
          .range_m = std::min({reading_m, options.usable_range_m, options.miss_free_range_m}),
          .hit = false};
    case BeamState::kTooNear:
    case BeamState::kInvalid:
      break;
  }
  return std::nullopt;
}

// Whether the reading is a lone miss: an echo that was lost, and no sign of free space. Beams
// that leave through a gap come in company.
bool IsLostEcho(const LaserScan& scan, std::size_t beam) {
  const auto is_miss = [&](std::size_t at) {
    return at < scan.size() && StateOf(scan.ranges_m[at], scan.geometry) == BeamState::kMiss;
  };
  return is_miss(beam) && !is_miss(beam + 1) && !(beam > 0 && is_miss(beam - 1));
}

// Where a beam ends, and whether on a surface.
struct BeamEnd {
  Eigen::Vector2d end_map_m;
  bool hit = false;
};

// Those of all beams that say something.
std::vector<BeamEnd> EndsOf(const RelevantScan& scan, const OccupancyGridOptions& options) {
  const LaserGeometry& geometry = scan.scan.geometry;
  const Pose2 T_map_laser = scan.map_robot.T_a_b * geometry.T_robot_laser;
  std::vector<BeamEnd> ends;
  if (!IsFinite(T_map_laser)) return ends;
  ends.reserve(scan.scan.size());
  for (std::size_t beam = 0; beam < scan.scan.size(); ++beam) {
    const std::optional<Sight> sight = SightOf(scan.scan.ranges_m[beam], geometry, options);
    if (!sight || IsLostEcho(scan.scan, beam)) continue;
    const double heading_rad = T_map_laser.theta_rad + geometry.Bearing(beam);
    const Eigen::Vector2d direction_map(std::cos(heading_rad), std::sin(heading_rad));
    ends.push_back({.end_map_m = T_map_laser.translation_m() + sight->range_m * direction_map,
                    .hit = sight->hit});
  }
  return ends;
}

Eigen::Vector2d LaserPosition(const RelevantScan& scan) {
  return scan.map_robot.T_a_b * scan.scan.geometry.T_robot_laser.translation_m();
}

// Of what a scan measured, the laser included; empty if nothing.
Eigen::AlignedBox2d ExtentOfEnds(const RelevantScan& scan, std::span<const BeamEnd> ends) {
  Eigen::AlignedBox2d extent;
  for (const BeamEnd& beam : ends) extent.extend(beam.end_map_m);
  if (!extent.isEmpty()) extent.extend(LaserPosition(scan));
  return extent;
}

// Cells along one side at most, with the margin. A double, as it may be too many for an integer.
double CellsAlong(double size_m, double cell_m) {
  return std::floor(size_m / cell_m) + 2.0 * kMarginCells + 2.0;
}

}  // namespace

Eigen::AlignedBox2d OccupancyPainter::ExtentOf(const RelevantScan& scan,
                                               const OccupancyGridOptions& options) {
  return ExtentOfEnds(scan, EndsOf(scan, options));
}

void OccupancyPainter::Add(const RelevantScan& scan) {
  const std::vector<BeamEnd> ends = EndsOf(scan, options_);
  const Eigen::AlignedBox2d extent_m = ExtentOfEnds(scan, ends);
  if (extent_m.isEmpty()) return;
  MakeRoom(extent_m);
  if (!Fits(extent_m_, options_.cell_m)) return;
  ++scan_;
  // Hits first: what a scan hit it does not also count as free.
  for (const BeamEnd& beam : ends) {
    if (beam.hit) CountHit(CellOf(beam.end_map_m));
  }
  const CellIndex laser = CellOf(LaserPosition(scan));
  for (const BeamEnd& beam : ends) CountFreeLine(laser, CellOf(beam.end_map_m));
}

void OccupancyPainter::MakeRoom(const Eigen::AlignedBox2d& box_map_m) {
  if (!extent_m_.isEmpty() && extent_m_.contains(box_map_m)) return;
  extent_m_.extend(box_map_m);
  if (!Fits(extent_m_, options_.cell_m)) {
    tiles_.clear();
    last_tile_ = nullptr;
    return;
  }
  const Frame needed = FrameAround(extent_m_);
  if (frame_.width == 0) {
    first_frame_ = needed;
    return GrowTo(needed);
  }
  const CellIndex at = Offset(needed, frame_);
  const bool is_there = at.x >= 0 && at.y >= 0 && at.x + needed.width <= frame_.width &&
                        at.y + needed.height <= frame_.height;
  if (is_there) return;
  // Some room to spare on every side, so that growing bit by bit costs little.
  const Eigen::Vector2d spare_m = kSpareShare * extent_m_.sizes();
  const Eigen::Vector2d low_m = extent_m_.min() - spare_m;
  const Eigen::Vector2d high_m = extent_m_.max() + spare_m;
  const Eigen::AlignedBox2d wide_m(low_m, high_m);
  GrowTo(Fits(wide_m, options_.cell_m) ? FrameAround(wide_m) : needed);
}

void OccupancyPainter::GrowTo(const Frame& grown) {
  frame_ = grown;
  at_ = Offset(frame_, first_frame_);
}

OccupancyGridResult OccupancyPainter::Grid() const {
  OccupancyGridResult result;
  if (extent_m_.isEmpty()) return result;
  result.extent_x_m = extent_m_.sizes().x();
  result.extent_y_m = extent_m_.sizes().y();
  result.smallest_cell_m = SmallestFittingCell();
  if (!Fits(extent_m_, options_.cell_m)) {
    result.status = RenderStatus::kTooLarge;
    return result;
  }
  const Frame frame = FrameAround(extent_m_);
  result.grid = {.cell_m = options_.cell_m,
                 .origin_map_m = frame.origin_map_m,
                 .width = frame.width,
                 .height = frame.height,
                 .cells = {}};
  result.grid.cells.resize(
      static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height),
      CellState::kUnknown);
  const CellIndex at = Offset(frame, first_frame_);
  for (const auto& [key, tile] : tiles_) {
    const CellIndex first = FirstCellOf(key);
    Draw(tile, {first.x - at.x, first.y - at.y}, result.grid);
  }
  result.status = RenderStatus::kRendered;
  return result;
}

// What is seen lies in the grid, but not all of a tile that has some of it.
void OccupancyPainter::Draw(const Tile& tile, CellIndex first, OccupancyGrid& grid) const {
  const int end_x = std::min(Tile::kSide, grid.width - first.x);
  const int end_y = std::min(Tile::kSide, grid.height - first.y);
  for (int y = std::max(0, -first.y); y < end_y; ++y) {
    for (int x = std::max(0, -first.x); x < end_x; ++x) {
      grid.cells[static_cast<std::size_t>(first.y + y) * static_cast<std::size_t>(grid.width) +
                 static_cast<std::size_t>(first.x + x)] = StateOfCell(tile.At({x, y}));
    }
  }
}

bool OccupancyPainter::Fits(const Eigen::AlignedBox2d& extent_m, double cell_m) const {
  const Eigen::Vector2d size_m = extent_m.sizes();
  const double cells = CellsAlong(size_m.x(), cell_m) * CellsAlong(size_m.y(), cell_m);
  const double furthest_m =
      extent_m.min().cwiseAbs().cwiseMax(extent_m.max().cwiseAbs()).maxCoeff();
  // False for anything not finite.
  return cells <= 1e6 * options_.max_megacells && furthest_m / cell_m <= kFurthestCell;
}

// The smallest cell of 1, 2 or 5 times a power of ten metres that fits.
double OccupancyPainter::SmallestFittingCell() const {
  for (double decade_m = 1e-3; decade_m < 1e9; decade_m *= 10.0) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (Fits(extent_m_, step * decade_m)) return step * decade_m;
    }
  }
  return std::numeric_limits<double>::infinity();
}

OccupancyPainter::Frame OccupancyPainter::FrameAround(const Eigen::AlignedBox2d& extent_m) const {
  const double cell_m = options_.cell_m;
  const double margin_m = kMarginCells * cell_m;
  Frame frame;
  frame.origin_map_m = ((extent_m.min().array() - margin_m) / cell_m).floor() * cell_m;
  const Eigen::Vector2d size_m = extent_m.max() - frame.origin_map_m;
  frame.width = static_cast<int>(size_m.x() / cell_m) + kMarginCells + 1;
  frame.height = static_cast<int>(size_m.y() / cell_m) + kMarginCells + 1;
  return frame;
}

// Where the corner of one frame lies in another.
OccupancyPainter::CellIndex OccupancyPainter::Offset(const Frame& inner, const Frame& outer) const {
  const Eigen::Vector2d cells = (inner.origin_map_m - outer.origin_map_m) / options_.cell_m;
  return {static_cast<int>(std::lround(cells.x())), static_cast<int>(std::lround(cells.y()))};
}

OccupancyPainter::CellIndex OccupancyPainter::CellOf(const Eigen::Vector2d& p_map_m) const {
  const Eigen::Vector2d cells = (p_map_m - frame_.origin_map_m) / options_.cell_m;
  return {static_cast<int>(cells.x()), static_cast<int>(cells.y())};
}

CellState OccupancyPainter::StateOfCell(const Cell& cell) const {
  if (cell.seen == 0) return CellState::kUnknown;
  const bool is_occupied = cell.hits > 0 && cell.hits >= options_.occupied_share * cell.seen;
  return is_occupied ? CellState::kOccupied : CellState::kFree;
}

// Counts the current scan in a cell, once. @return the cell if it had not been counted.
OccupancyPainter::Cell* OccupancyPainter::CountSeen(CellIndex index) {
  const CellIndex in_first{index.x + at_.x, index.y + at_.y};
  const std::uint64_t key = Key(in_first);
  if (last_tile_ == nullptr || key != last_key_) {
    last_key_ = key;
    last_tile_ = &tiles_[key];
  }
  Cell* cell = last_tile_->FirstTime(scan_, in_first);
  if (cell == nullptr) return nullptr;
  if (cell->seen == std::numeric_limits<std::uint16_t>::max()) {
    cell->seen /= 2;
    cell->hits /= 2;
  }
  ++cell->seen;
  return cell;
}

void OccupancyPainter::CountHit(CellIndex index) {
  if (Cell* cell = CountSeen(index)) ++cell->hits;
}

// All cells on the line but the last one, by Bresenham's algorithm (1965).
void OccupancyPainter::CountFreeLine(CellIndex from, CellIndex to) {
  const int dx = std::abs(to.x - from.x);
  const int dy = -std::abs(to.y - from.y);
  const int step_x = from.x < to.x ? 1 : -1;
  const int step_y = from.y < to.y ? 1 : -1;
  int error = dx + dy;
  for (CellIndex at = from; at.x != to.x || at.y != to.y;) {
    CountSeen(at);
    const int doubled = 2 * error;
    if (doubled >= dy) {
      error += dy;
      at.x += step_x;
    }
    if (doubled <= dx) {
      error += dx;
      at.y += step_y;
    }
  }
}

}  // namespace qwsm
