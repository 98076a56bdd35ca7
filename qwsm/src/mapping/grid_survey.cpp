// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/grid_survey.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "qwsm/geometry/moments.hpp"
#include "qwsm/matching/surface_map.hpp"

namespace qwsm {
namespace {

constexpr int kBeams = 720;
constexpr double kRange_m = 15.0;
constexpr double kStandoff_m = 3.0;      // Of the laser from what it is to show.
constexpr int kLineReach_cells = 2;      // Cells so near tell where their surface lies.
constexpr double kMaxLineAspect = 0.35;  // Of a line's variances.
constexpr double kMinAlong_cells = 1.0;  // Sigma of so many cells in a row along their line.

using Cell = Eigen::Vector2i;
constexpr std::array<std::array<int, 2>, 4> kBeside = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

// The line of the occupied cells around one, in cells.
struct CellSurface {
  Eigen::Vector2d mean;
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  // Zero where they are no line.
};

// Surveys one grid. Coordinates are in cells, (0.5, 0.5) in the middle of the first one.
class Surveyor {
 public:
  explicit Surveyor(const OccupancyGrid& grid) : grid_(grid), is_shown_(grid.cells.size(), false) {}

  ScanMap Survey(const ScanMapOptions& options) {
    ScanMap map(options);
    for (int y = 0; y < grid_.height; ++y) {
      for (int x = 0; x < grid_.width; ++x) {
        const Cell cell(x, y);
        const Eigen::Vector2d outward = Outward(cell);
        if (is_shown_[IndexOf(cell)] || outward.isZero()) continue;
        TakeScan(Viewpoint(cell, outward), map);
        is_shown_[IndexOf(cell)] = true;
      }
    }
    return map;
  }

 private:
  bool Is(CellState state, const Cell& cell) const {
    return cell.x() >= 0 && cell.y() >= 0 && cell.x() < grid_.width && cell.y() < grid_.height &&
           grid_.At(cell.x(), cell.y()) == state;
  }
  std::size_t IndexOf(const Cell& cell) const { return grid_.Index(cell.x(), cell.y()); }

  // Towards the free cells beside an occupied one; zero if it is in nobody's view.
  Eigen::Vector2d Outward(const Cell& cell) const {
    Eigen::Vector2d outward = Eigen::Vector2d::Zero();
    if (!Is(CellState::kOccupied, cell)) return outward;
    Eigen::Vector2d any = outward;
    for (const auto& [dx, dy] : kBeside) {
      if (!Is(CellState::kFree, cell + Cell(dx, dy))) continue;
      any = Eigen::Vector2d(dx, dy);
      outward += any;
    }
    return outward.isZero() ? any : outward.normalized();
  }

  // Half way to what stands opposite, but not too far off. @pre `outward` leads to a free cell.
  Eigen::Vector2d Viewpoint(const Cell& cell, const Eigen::Vector2d& outward) const {
    const Eigen::Vector2d begin = cell.cast<double>().array() + 0.5;
    double free = 1.0;
    while (free * grid_.cell_m < 2.0 * kStandoff_m &&
           Is(CellState::kFree, CellAt(begin + (free + 1.0) * outward))) {
      free += 1.0;
    }
    return begin + std::max(1.0, 0.5 * free) * outward;
  }

  static Cell CellAt(const Eigen::Vector2d& p) {
    return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
  }

  void TakeScan(const Eigen::Vector2d& from, ScanMap& map) {
    LaserScan scan;
    const float step_rad = static_cast<float>(2.0 * std::numbers::pi / kBeams);
    scan.geometry = {.first_bearing_rad = -static_cast<float>(std::numbers::pi),
                     .bearing_step_rad = step_rad,
                     .range_min_m = 0.0F,
                     .range_max_m = static_cast<float>(kRange_m) / kMissShareOfMaximum,
                     .T_robot_laser = {}};
    for (std::size_t beam = 0; beam < kBeams; ++beam) {
      const double bearing_rad = scan.geometry.Bearing(beam);
      const double range_m = RangeAlong(from, {std::cos(bearing_rad), std::sin(bearing_rad)});
      scan.ranges_m.push_back(static_cast<float>(range_m));
    }
    const Eigen::Vector2d p_map_m = grid_.origin_map_m + grid_.cell_m * from;
    const double half_cell_m2 = UniformVariance(grid_.cell_m);
    UncertainPose2 map_laser{.T_a_b = {.x_m = p_map_m.x(), .y_m = p_map_m.y()}};
    map_laser.covariance.diagonal() = Eigen::Vector3d(half_cell_m2, half_cell_m2, 0.0);
    map.Insert(std::move(scan), map_laser);
  }

  // To the surface of the first cell that is not free: infinite where that is unknown, or there is
  // none in reach.
  double RangeAlong(const Eigen::Vector2d& from, const Eigen::Vector2d& direction) {
    constexpr double kHalfCell = 0.5;
    constexpr double kNone = std::numeric_limits<double>::infinity();
    for (double way = 0.0; way * grid_.cell_m < kRange_m; way += kHalfCell) {
      const Cell cell = CellAt(from + way * direction);
      if (Is(CellState::kFree, cell)) continue;
      if (!Is(CellState::kOccupied, cell)) return kNone;
      // Where beams lie further apart than cells, another scan shows it better.
      if (way * 2.0 * std::numbers::pi / kBeams <= 1.0) is_shown_[IndexOf(cell)] = true;
      return grid_.cell_m * WayTo(SurfaceAt(cell), from, direction);
    }
    return kNone;
  }

  CellSurface SurfaceAt(const Cell& cell) const {
    std::vector<Eigen::Vector2d> around;
    for (int dy = -kLineReach_cells; dy <= kLineReach_cells; ++dy) {
      for (int dx = -kLineReach_cells; dx <= kLineReach_cells; ++dx) {
        const Cell other = cell + Cell(dx, dy);
        if (!Outward(other).isZero()) around.emplace_back(other.cast<double>().array() + 0.5);
      }
    }
    CellSurface surface{.mean = Eigen::Vector2d::Zero()};
    for (const Eigen::Vector2d& p : around) surface.mean += p / static_cast<double>(around.size());
    Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
    for (const Eigen::Vector2d& p : around) {
      scatter +=
          (p - surface.mean) * (p - surface.mean).transpose() / static_cast<double>(around.size());
    }
    const PrincipalAxes axes = PrincipalAxesOf(scatter(0, 0), scatter(0, 1), scatter(1, 1));
    if (axes.major_m2 >= kMinAlong_cells && axes.minor_m2 <= kMaxLineAspect * axes.major_m2) {
      surface.normal = axes.minor_axis;
    } else {
      surface.mean = cell.cast<double>().array() + 0.5;
    }
    return surface;
  }

  // A beam that grazes a line ends beside the middle of its cells.
  static double WayTo(const CellSurface& surface,
                      const Eigen::Vector2d& from,
                      const Eigen::Vector2d& direction) {
    constexpr double kGrazing = 0.3;
    const Eigen::Vector2d to_mean = surface.mean - from;
    const double cosine = surface.normal.dot(direction);
    if (std::abs(cosine) < kGrazing) return to_mean.dot(direction);
    return surface.normal.dot(to_mean) / cosine;
  }

  const OccupancyGrid& grid_;
  std::vector<bool> is_shown_;
};

}  // namespace

ScanMap SurveyGrid(const OccupancyGrid& grid, const ScanMapOptions& options) {
  return Surveyor(grid).Survey(options);
}

}  // namespace qwsm
