// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/point_quadtree.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace qwsm {

using quadtree::FixedPoint;
using quadtree::kUnitsPerCell;
using quadtree::Origin;

namespace {

/// The first point gets this cell. In binary it is 0101..., so that of the squares around it none
/// has it near a corner, and a root that doubles grows to the lower left and to the upper right in
/// turn.
constexpr double kFirstCell = 0x55555555;
constexpr double kCellsPerAxis = 4294967296.0;
/// Above, doubles no longer tell a thousandth of a cell.
constexpr double kMaxCells = 1e12;

std::uint16_t ToFraction(double share_of_cell) {
  return static_cast<std::uint16_t>(
      std::min(std::round(share_of_cell * kUnitsPerCell), kUnitsPerCell - 1));
}

quadtree::MergeLedger::Contribution ContributionOf(const FixedPoint& p, ScanId scan) {
  return {.scan = scan, .fraction_x = p.fraction_x, .fraction_y = p.fraction_y};
}

}  // namespace

/// The upper bits are the tree's, the lower ones count its changes.
quadtree::Revision::Revision() {
  static std::atomic<std::uint64_t> trees = 0;
  value_ = ++trees << 36;
}

PointQuadtree::PointQuadtree(const PointQuadtreeOptions& options)
    : options_(options), cells_per_metre_(1.0 / options.cell_size_m) {
  if (!(cells_per_metre_ > 0.0) || !std::isfinite(cells_per_metre_)) {
    throw std::invalid_argument("PointQuadtree: cell_size_m must be positive and finite, not " +
                                std::to_string(options.cell_size_m));
  }
}

std::optional<PointQuadtree::Insertion> PointQuadtree::Insert(const Eigen::Vector2d& p_m,
                                                              ScanId scan) {
  if (scan >= kScanEnd || (tree_.empty() && !CenterOn(p_m))) return std::nullopt;
  const std::optional<FixedPoint> p = Locate(p_m);
  if (!p) return std::nullopt;
  revision_.Advance();
  const PointId id = tree_.FindOrInsert(*p, origins_.next());
  const bool is_new = id == origins_.next();
  if (is_new) origins_.Add(Origin::Scan(scan));
  const FixedPoint stored = is_new ? *p : Merge(id, *p, scan);
  return Insertion{
      .id = id, .merged = !is_new, .position_m = ToMetres(quadtree::ToUnitPoint(stored))};
}

/// Adds a point to the one stored in its cell, and returns that.
FixedPoint PointQuadtree::Merge(PointId id, const FixedPoint& p, ScanId scan) {
  Origin& origin = origins_[id];
  if (!origin.is_account()) {
    const std::uint32_t account = ledger_.Open();
    ledger_.Add(account, ContributionOf(tree_.PointIn(p.cell), origin.scan()));
    origin = Origin::Account(account);
  }
  ledger_.Add(origin.account(), ContributionOf(p, scan));
  return MoveToMean(p.cell, origin.account());
}

FixedPoint PointQuadtree::MoveToMean(quadtree::Cell cell, std::uint32_t account) {
  const FixedPoint mean{cell, ledger_.mean_x(account), ledger_.mean_y(account)};
  tree_.Move(mean);
  return mean;
}

std::size_t PointQuadtree::RemoveScan(ScanId scan) {
  revision_.Advance();
  std::vector<std::pair<PointId, quadtree::Cell>> points;  // By id, so that ids are freed in order.
  const auto add = [&](PointId id, const quadtree::UnitPoint& p) {
    points.emplace_back(id, quadtree::CellAt(p));
  };
  quadtree::VisitAll(tree_, add);
  std::ranges::sort(points, {}, &std::pair<PointId, quadtree::Cell>::first);
  std::size_t withdrawn = 0;
  for (const auto& [id, cell] : points) withdrawn += Withdraw(id, cell, scan);
  return withdrawn;
}

std::size_t PointQuadtree::Withdraw(PointId id, quadtree::Cell cell, ScanId scan) {
  Origin& origin = origins_[id];
  if (!origin.is_account()) {
    if (origin.scan() != scan) return 0;
    Remove(id, cell);
    return 1;
  }
  const std::uint32_t account = origin.account();
  const std::size_t withdrawn = ledger_.Withdraw(account, scan);
  if (withdrawn == 0) return 0;
  if (ledger_.count(account) == 0) {
    Remove(id, cell);
    return withdrawn;
  }
  MoveToMean(cell, account);
  if (ledger_.count(account) == 1) {
    origin = Origin::Scan(ledger_.oldest_scan(account));
    ledger_.Close(account);
  }
  return withdrawn;
}

void PointQuadtree::Remove(PointId id, quadtree::Cell cell) {
  tree_.Remove(cell);
  Origin& origin = origins_[id];
  if (origin.is_account()) ledger_.Close(origin.account());
  origin = Origin();
  origins_.Free(id);
}

std::uint32_t PointQuadtree::Count(PointId id) const {
  assert(Contains(id));
  const Origin origin = origins_[id];
  return origin.is_account() ? ledger_.count(origin.account()) : 1;
}

ScanId PointQuadtree::Scan(PointId id) const {
  assert(Contains(id));
  const Origin origin = origins_[id];
  return origin.is_account() ? ledger_.oldest_scan(origin.account()) : origin.scan();
}

std::vector<Eigen::Vector2d> PointQuadtree::Positions() const {
  std::vector<Eigen::Vector2d> positions_m(id_end());
  ForEach([&](PointId id, const Eigen::Vector2d& p_m) { positions_m[id] = p_m; });
  return positions_m;
}

PointQuadtreeStatistics PointQuadtree::Statistics() const {
  return {.points = size(),
          .merged_points = ledger_.account_count(),
          .nodes = tree_.inner_count() + tree_.leaf_count(),
          .leaves = tree_.leaf_count(),
          .depth = tree_.Depth(),
          .bytes = sizeof(*this) + tree_.bytes() + origins_.bytes() + ledger_.bytes()};
}

std::optional<FixedPoint> PointQuadtree::Locate(const Eigen::Vector2d& p_m) const {
  const double x = p_m.x() * cells_per_metre_ - origin_x_cells_;
  const double y = p_m.y() * cells_per_metre_ - origin_y_cells_;
  const bool is_inside = x >= 0.0 && x < kCellsPerAxis && y >= 0.0 && y < kCellsPerAxis;
  if (!is_inside) return std::nullopt;  // Nor is a NaN.
  const quadtree::Cell cell{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)};
  return FixedPoint{cell, ToFraction(x - cell.x), ToFraction(y - cell.y)};
}

/// Lays the largest square so that there is room about the first point. @pre there is no point
bool PointQuadtree::CenterOn(const Eigen::Vector2d& p_m) {
  const Eigen::Vector2d cells = p_m * cells_per_metre_;
  const bool is_representable = std::abs(cells.x()) < kMaxCells && std::abs(cells.y()) < kMaxCells;
  if (!is_representable) return false;  // Nor is a NaN.
  origin_x_cells_ = std::floor(cells.x()) - kFirstCell;
  origin_y_cells_ = std::floor(cells.y()) - kFirstCell;
  return true;
}

}  // namespace qwsm
