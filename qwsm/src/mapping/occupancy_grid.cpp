// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>

namespace qwsm {
namespace {

// Free cells around what was measured, so that no wall lies on the border.
constexpr int kMarginCells = 4;

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

// Calls `visit(end_map_m, hit)` for every beam that says something.
template <class Visit>
void ForEachSight(const RelevantScan& scan, const OccupancyGridOptions& options, Visit visit) {
  const LaserGeometry& geometry = scan.scan.geometry;
  const Pose2 T_map_laser = scan.map_robot.T_a_b * geometry.T_robot_laser;
  if (!IsFinite(T_map_laser)) return;
  for (std::size_t beam = 0; beam < scan.scan.size(); ++beam) {
    const std::optional<Sight> sight = SightOf(scan.scan.ranges_m[beam], geometry, options);
    if (!sight || IsLostEcho(scan.scan, beam)) continue;
    const double heading_rad = T_map_laser.theta_rad + geometry.Bearing(beam);
    const Eigen::Vector2d direction_map(std::cos(heading_rad), std::sin(heading_rad));
    visit(Eigen::Vector2d(T_map_laser.translation_m() + sight->range_m * direction_map),
          sight->hit);
  }
}

Eigen::Vector2d LaserPosition(const RelevantScan& scan) {
  return scan.map_robot.T_a_b * scan.scan.geometry.T_robot_laser.translation_m();
}

struct Extent {
  Eigen::Vector2d low_m = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high_m = Eigen::Vector2d::Constant(-std::numeric_limits<double>::infinity());

  void Include(const Eigen::Vector2d& p_map_m) {
    low_m = low_m.cwiseMin(p_map_m);
    high_m = high_m.cwiseMax(p_map_m);
  }
  bool empty() const { return !(low_m.x() <= high_m.x()); }
};

Extent ExtentOf(std::span<const RelevantScan> scans, const OccupancyGridOptions& options) {
  Extent extent;
  for (const RelevantScan& scan : scans) {
    ForEachSight(scan, options, [&](const Eigen::Vector2d& end_map_m, bool) {
      extent.Include(end_map_m);
      extent.Include(LaserPosition(scan));
    });
  }
  return extent;
}

// Cells along one side at most, with the margin. A double, as it may be too many for an integer.
double CellsAlong(double size_m, double cell_m) {
  return std::floor(size_m / cell_m) + 2.0 * kMarginCells + 2.0;
}

bool Fits(const Extent& extent, double cell_m, int max_megacells) {
  const Eigen::Vector2d size_m = extent.high_m - extent.low_m;
  const double cells = CellsAlong(size_m.x(), cell_m) * CellsAlong(size_m.y(), cell_m);
  const double furthest_m = extent.low_m.cwiseAbs().cwiseMax(extent.high_m.cwiseAbs()).maxCoeff();
  // False for anything not finite.
  return cells <= 1e6 * max_megacells && furthest_m / cell_m <= kFurthestCell;
}

// The smallest cell of 1, 2 or 5 times a power of ten metres that fits.
double SmallestFittingCell(const Extent& extent, int max_megacells) {
  for (double decade_m = 1e-3; decade_m < 1e9; decade_m *= 10.0) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (Fits(extent, step * decade_m, max_megacells)) return step * decade_m;
    }
  }
  return std::numeric_limits<double>::infinity();
}

struct CellIndex {
  int x = 0;
  int y = 0;
};

// How often cells were seen, and hit, one scan after the other.
class SightCounter {
 public:
  SightCounter(const Extent& extent, double cell_m) : cell_m_(cell_m) {
    const double margin_m = kMarginCells * cell_m;
    // On the lattice of whole cells, so that maps of one run lie on each other cell by cell.
    origin_m_ = ((extent.low_m.array() - margin_m) / cell_m).floor() * cell_m;
    const Eigen::Vector2d size_m = extent.high_m - origin_m_;
    width_ = static_cast<int>(size_m.x() / cell_m) + kMarginCells + 1;
    height_ = static_cast<int>(size_m.y() / cell_m) + kMarginCells + 1;
    cells_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  }

  void Add(const RelevantScan& scan, const OccupancyGridOptions& options) {
    ++scan_;
    // Hits first: what a scan hit it does not also count as free.
    ForEachSight(scan, options, [&](const Eigen::Vector2d& end_map_m, bool hit) {
      if (hit) CountHit(CellOf(end_map_m));
    });
    const CellIndex laser = CellOf(LaserPosition(scan));
    ForEachSight(scan, options, [&](const Eigen::Vector2d& end_map_m, bool) {
      CountFreeLine(laser, CellOf(end_map_m));
    });
  }

  OccupancyGrid Grid(double occupied_share) const {
    OccupancyGrid grid{.cell_m = cell_m_,
                       .origin_map_m = origin_m_,
                       .width = width_,
                       .height = height_,
                       .cells = std::vector<CellState>(cells_.size(), CellState::kUnknown)};
    std::ranges::transform(cells_, grid.cells.begin(), [&](const Cell& cell) {
      if (cell.seen == 0) return CellState::kUnknown;
      const bool is_occupied = cell.hits > 0 && cell.hits >= occupied_share * cell.seen;
      return is_occupied ? CellState::kOccupied : CellState::kFree;
    });
    return grid;
  }

 private:
  struct Cell {
    std::uint32_t last_scan = 0;
    std::uint16_t seen = 0;
    std::uint16_t hits = 0;
  };

  CellIndex CellOf(const Eigen::Vector2d& p_map_m) const {
    return {static_cast<int>((p_map_m.x() - origin_m_.x()) / cell_m_),
            static_cast<int>((p_map_m.y() - origin_m_.y()) / cell_m_)};
  }

  Cell& At(CellIndex index) {
    return cells_[static_cast<std::size_t>(index.y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(index.x)];
  }

  // Counts the current scan, once. True if it had not been counted.
  bool CountSeen(Cell& cell) {
    if (cell.last_scan == scan_) return false;
    cell.last_scan = scan_;
    if (cell.seen == std::numeric_limits<std::uint16_t>::max()) {
      cell.seen /= 2;
      cell.hits /= 2;
    }
    ++cell.seen;
    return true;
  }

  void CountHit(CellIndex index) {
    Cell& cell = At(index);
    if (CountSeen(cell)) ++cell.hits;
  }

  // All cells on the line but the last one, by Bresenham's algorithm.
  void CountFreeLine(CellIndex from, CellIndex to) {
    const int dx = std::abs(to.x - from.x);
    const int dy = -std::abs(to.y - from.y);
    const int step_x = from.x < to.x ? 1 : -1;
    const std::ptrdiff_t row = from.y < to.y ? width_ : -width_;
    Cell* cell = &At(from);
    int error = dx + dy;
    for (const Cell* const last = &At(to); cell != last;) {
      CountSeen(*cell);
      const int doubled = 2 * error;
      if (doubled >= dy) {
        error += dy;
        cell += step_x;
      }
      if (doubled <= dx) {
        error += dx;
        cell += row;
      }
    }
  }

  double cell_m_ = 0.0;
  Eigen::Vector2d origin_m_;
  int width_ = 0;
  int height_ = 0;
  std::vector<Cell> cells_;
  std::uint32_t scan_ = 0;
};

}  // namespace

OccupancyGridResult RenderOccupancyGrid(std::span<const RelevantScan> scans,
                                        const OccupancyGridOptions& options) {
  const Extent extent = ExtentOf(scans, options);
  OccupancyGridResult result;
  if (extent.empty()) return result;
  result.extent_x_m = extent.high_m.x() - extent.low_m.x();
  result.extent_y_m = extent.high_m.y() - extent.low_m.y();
  result.smallest_cell_m = SmallestFittingCell(extent, options.max_megacells);
  if (!Fits(extent, options.cell_m, options.max_megacells)) {
    result.status = RenderStatus::kTooLarge;
    return result;
  }
  SightCounter counter(extent, options.cell_m);
  for (const RelevantScan& scan : scans) counter.Add(scan, options);
  result.grid = counter.Grid(options.occupied_share);
  result.status = RenderStatus::kRendered;
  return result;
}

}  // namespace qwsm
