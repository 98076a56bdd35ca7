// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/search/point_quadtree.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace qwsm {

using quadtree::FixedPoint;
using quadtree::kNoIndex;
using quadtree::kUnitsPerCell;

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
  if (tree_.empty() && !CenterOn(p_m)) return std::nullopt;
  const std::optional<FixedPoint> p = Locate(p_m);
  if (!p) return std::nullopt;
  revision_.Advance();
  const PointId id = tree_.FindOrInsert(*p, points_.next());
  const bool is_new = id == points_.next();
  if (is_new) {
    points_.Add({.position = *p, .scan = scan, .account = kNoIndex});
  } else {
    Merge(id, *p, scan);
  }
  return Insertion{.id = id, .merged = !is_new};
}

void PointQuadtree::Merge(PointId id, const FixedPoint& p, ScanId scan) {
  Record& record = points_[id];
  if (record.account == kNoIndex) {
    record.account = ledger_.Open();
    ledger_.Add(record.account, ContributionOf(record.position, record.scan));
  }
  ledger_.Add(record.account, ContributionOf(p, scan));
  MoveToMean(record);
}

void PointQuadtree::MoveToMean(Record& record) {
  record.position.fraction_x = ledger_.mean_x(record.account);
  record.position.fraction_y = ledger_.mean_y(record.account);
  tree_.Move(record.position);
}

std::size_t PointQuadtree::RemoveScan(ScanId scan) {
  revision_.Advance();
  std::size_t withdrawn = 0;
  for (PointId id = 0; id < points_.end(); ++id) {
    if (Contains(id)) withdrawn += Withdraw(id, scan);
  }
  return withdrawn;
}

std::size_t PointQuadtree::Withdraw(PointId id, ScanId scan) {
  Record& record = points_[id];
  if (record.account == kNoIndex) {
    if (record.scan != scan) return 0;
    Remove(id);
    return 1;
  }
  const std::size_t withdrawn = ledger_.Withdraw(record.account, scan);
  if (withdrawn == 0) return 0;
  if (ledger_.count(record.account) == 0) {
    Remove(id);
    return withdrawn;
  }
  record.scan = ledger_.Oldest(record.account).scan;
  MoveToMean(record);
  if (ledger_.count(record.account) == 1) {
    ledger_.Close(record.account);
    record.account = kNoIndex;
  }
  return withdrawn;
}

void PointQuadtree::Remove(PointId id) {
  Record& record = points_[id];
  tree_.Remove(record.position.cell);
  if (record.account != kNoIndex) ledger_.Close(record.account);
  record.account = kNotStored;
  points_.Free(id);
}

bool PointQuadtree::Contains(PointId id) const {
  return id < points_.end() && points_[id].account != kNotStored;
}

std::uint32_t PointQuadtree::Count(PointId id) const {
  assert(Contains(id));
  return points_[id].account == kNoIndex ? 1 : ledger_.count(points_[id].account);
}

ScanId PointQuadtree::Scan(PointId id) const {
  assert(Contains(id));
  return points_[id].scan;
}

PointQuadtreeStatistics PointQuadtree::Statistics() const {
  return {.points = points_.size(),
          .merged_points = ledger_.account_count(),
          .nodes = tree_.inner_count() + tree_.leaf_count(),
          .leaves = tree_.leaf_count(),
          .depth = tree_.Depth(),
          .bytes = sizeof(*this) + tree_.bytes() + points_.bytes() + ledger_.bytes()};
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
