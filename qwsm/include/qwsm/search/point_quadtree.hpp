// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "qwsm/search/detail/cell_quadtree.hpp"
#include "qwsm/search/detail/merge_ledger.hpp"
#include "qwsm/search/detail/quadtree_traversal.hpp"
#include "qwsm/search/search_cursor.hpp"

namespace qwsm {

struct PointQuadtreeOptions {
  double cell_size_m = 0.001;
};

template <class Visitor>
void Describe(Visitor& visit, PointQuadtreeOptions& o) {
  visit("cell_size_m",
        o.cell_size_m,
        {.help = "side of the smallest cell; points in one cell are merged",
         .min = 1e-5,
         .max = 0.1});
}

using ScanId = std::uint32_t;

/// Answer to a search.
struct Neighbor {
  PointId id = 0;
  double distance_m2 = 0.0;  ///< Squared.
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
};

struct PointQuadtreeStatistics {
  std::size_t points = 0;
  std::size_t merged_points = 0;  ///< Points that stand for more than one insertion.
  std::size_t nodes = 0;          ///< Inner nodes and leaves.
  std::size_t leaves = 0;
  int depth = 0;          ///< Nodes from the root to the deepest leaf, both counted.
  std::size_t bytes = 0;  ///< All memory held.
};

/// Points of the plane, found by place: the map that Visser et al. (2009, section 3) match scans
/// to. A point-region quadtree (Samet 1984) over cells of a millimetre.
///
/// Points of one cell are merged to their mean. Positions are kept to 1/1024 cell however far from
/// the origin, unlike in floats. The root is no larger than the points need, and doubles when one
/// falls outside. Leaves hold up to 20 points, and take memory for those they hold
/// (quadtree_layout.hpp).
///
/// Cost: insertion and search O(depth), and depth grows with the logarithm of extent over spacing.
/// Insertion moves no more than a leaf, so there are no pauses. About 20 bytes per point;
/// measured by quadtree_bench. Const members may run on several threads at once.
class PointQuadtree {
 public:
  /// Scans are numbered below: 2^31 - 1.
  static constexpr ScanId kScanEnd = quadtree::Origin::kScanEnd;

  struct Insertion {
    PointId id = 0;
    bool merged = false;  ///< The point was added to one already stored in its cell.
    Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< Where the point is stored now.
  };

  /// @throws std::invalid_argument if the cell size is not positive and finite.
  explicit PointQuadtree(const PointQuadtreeOptions& options = {});

  /// Adds a point. Refused with nothing returned and nothing changed: a point that is not finite,
  /// or not within 1.4e9 cells (1431 km at a millimetre), by x and by y, of the first point stored;
  /// a scan not below kScanEnd.
  std::optional<Insertion> Insert(const Eigen::Vector2d& p_m, ScanId scan);

  /// Takes out what a scan contributed: its own points, and its share of merged ones.
  /// @return how many insertions were undone. Cost: one pass over all points, for they are not
  /// listed by scan.
  std::size_t RemoveScan(ScanId scan);

  bool Contains(PointId id) const { return id < origins_.end() && origins_[id]; }
  /// How many points were merged. @pre Contains(id), here and below.
  std::uint32_t Count(PointId id) const;
  /// The oldest contributor.
  ScanId Scan(PointId id) const;

  /// The nearest point not farther than `max_distance_m`; exact.
  std::optional<Neighbor> Nearest(const Eigen::Vector2d& query_m, double max_distance_m) const;

  /// Finds a nearest point at the same distance, but quicker if the cursor comes from a search
  /// nearby. A cursor from another tree, or from before a change of this one, is noticed and starts
  /// afresh.
  std::optional<Neighbor> Nearest(const Eigen::Vector2d& query_m,
                                  double max_distance_m,
                                  SearchCursor& cursor) const;

  /// The nearest point of which accept(PointId) is true, not farther than `max_distance_m`; exact.
  template <class Accept>
  std::optional<Neighbor> NearestIf(const Eigen::Vector2d& query_m,
                                    double max_distance_m,
                                    Accept accept) const;

  /// A cursor for a first search at a place. Making those of many places before the searches is
  /// quicker, for meanwhile the memory they need is fetched.
  /// @param near that of a place nearby makes it quicker, too.
  SearchCursor CursorAt(const Eigen::Vector2d& p_m, const SearchCursor& near = {}) const;

  /// The `k` nearest points not farther than `max_distance_m`, nearest first, replacing `out`.
  void KNearest(const Eigen::Vector2d& query_m,
                std::size_t k,
                double max_distance_m,
                std::vector<Neighbor>& out) const;

  /// How many points are not farther than `radius_m`, or `at_most` if there are more.
  int CountInRadius(const Eigen::Vector2d& center_m, double radius_m, int at_most) const;

  /// Where the points are, by id; of ids that no point has, anything. Where points were merged, it
  /// is their mean. Cost: linear in the points, whose places are not listed by id.
  std::vector<Eigen::Vector2d> Positions() const;

  /// Calls visit(PointId, Eigen::Vector2d position_m) for all points, in no particular order, and
  /// so do those below.
  template <class Visit>
  void ForEach(Visit visit) const;

  /// Calls visit(PointId, Eigen::Vector2d position_m) for the points not farther than `radius_m`,
  /// in no particular order.
  template <class Visit>
  void ForEachInRadius(const Eigen::Vector2d& center_m, double radius_m, Visit visit) const;

  /// Calls visit(PointId, Eigen::Vector2d position_m) for the points in the box, border included,
  /// in no particular order.
  template <class Visit>
  void ForEachInBox(const Eigen::AlignedBox2d& box_m, Visit visit) const;

  std::size_t size() const { return origins_.size(); }
  bool empty() const { return size() == 0; }
  /// One more than the largest id ever given: the size of arrays indexed by id.
  PointId id_end() const { return origins_.end(); }
  const PointQuadtreeOptions& options() const { return options_; }
  /// Cost: linear in the nodes.
  PointQuadtreeStatistics Statistics() const;

 private:
  // Positions: metres outside, units from the corner of the largest square inside.
  quadtree::UnitPoint ToUnits(const Eigen::Vector2d& p_m) const {
    return {(p_m.x() * cells_per_metre_ - origin_x_cells_) * quadtree::kUnitsPerCell,
            (p_m.y() * cells_per_metre_ - origin_y_cells_) * quadtree::kUnitsPerCell};
  }
  double ToUnits(double distance_m) const {
    return distance_m * cells_per_metre_ * quadtree::kUnitsPerCell;
  }
  Eigen::Vector2d ToMetres(const quadtree::UnitPoint& p) const {
    return {(origin_x_cells_ + p.x / quadtree::kUnitsPerCell) * options_.cell_size_m,
            (origin_y_cells_ + p.y / quadtree::kUnitsPerCell) * options_.cell_size_m};
  }
  std::optional<quadtree::FixedPoint> Locate(const Eigen::Vector2d& p_m) const;
  bool CenterOn(const Eigen::Vector2d& p_m);
  Neighbor ToNeighbor(PointId id, double distance2, const quadtree::UnitPoint& p) const {
    const double metres_per_unit = options_.cell_size_m / quadtree::kUnitsPerCell;
    return {.id = id,
            .distance_m2 = distance2 * metres_per_unit * metres_per_unit,
            .position_m = ToMetres(p)};
  }

  quadtree::FixedPoint Merge(PointId id, const quadtree::FixedPoint& p, ScanId scan);
  quadtree::FixedPoint MoveToMean(quadtree::Cell cell, std::uint32_t account);
  std::size_t Withdraw(PointId id, quadtree::Cell cell, ScanId scan);
  void Remove(PointId id, quadtree::Cell cell);

  PointQuadtreeOptions options_;
  double cells_per_metre_;
  double origin_x_cells_ = 0.0;  ///< Corner of the largest square; whole numbers.
  double origin_y_cells_ = 0.0;
  quadtree::CellQuadtree tree_;
  PagedPool<quadtree::Origin, 10> origins_;  ///< By id.
  quadtree::MergeLedger ledger_;
  quadtree::Revision revision_;
};

template <class Visit>
void PointQuadtree::ForEach(Visit visit) const {
  const auto visit_point = [&](PointId id, const quadtree::UnitPoint& p) {
    visit(id, ToMetres(p));
  };
  quadtree::VisitAll(tree_, visit_point);
}

template <class Accept>
std::optional<Neighbor> PointQuadtree::NearestIf(const Eigen::Vector2d& query_m,
                                                 double max_distance_m,
                                                 Accept accept) const {
  const quadtree::UnitPoint query = ToUnits(query_m);
  const double radius = ToUnits(max_distance_m);
  if (!(radius >= 0.0) || !quadtree::IsFinite(query)) return std::nullopt;
  quadtree::NearestAccepted nearest(tree_, query, radius, accept);
  quadtree::Traversal(tree_, query, nearest).Run(quadtree::SmallestAround(tree_, query, radius));
  if (!nearest.found()) return std::nullopt;
  return ToNeighbor(nearest.id(), nearest.distance2(), nearest.position());
}

template <class Visit>
void PointQuadtree::ForEachInRadius(const Eigen::Vector2d& center_m,
                                    double radius_m,
                                    Visit visit) const {
  const quadtree::UnitPoint center = ToUnits(center_m);
  const double radius = ToUnits(radius_m);
  if (!(radius >= 0.0) || !quadtree::IsFinite(center)) return;
  const auto visit_point = [&](PointId id, const quadtree::UnitPoint& p) {
    visit(id, ToMetres(p));
  };
  quadtree::Disk disk(tree_, center, radius, visit_point);
  quadtree::Traversal(tree_, center, disk).Run(quadtree::SmallestAround(tree_, center, radius));
}

template <class Visit>
void PointQuadtree::ForEachInBox(const Eigen::AlignedBox2d& box_m, Visit visit) const {
  if (box_m.isEmpty()) return;
  const quadtree::UnitPoint low = ToUnits(Eigen::Vector2d(box_m.min()));
  const quadtree::UnitPoint high = ToUnits(Eigen::Vector2d(box_m.max()));
  const auto visit_point = [&](PointId id, const quadtree::UnitPoint& p) {
    visit(id, ToMetres(p));
  };
  quadtree::VisitBox(tree_, tree_.root(), low, high, visit_point);
}

}  // namespace qwsm
