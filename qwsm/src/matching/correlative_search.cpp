// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/correlative_search.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "qwsm/search/likelihood_window.hpp"

namespace qwsm {
namespace {

constexpr int kFullLikelihood = std::numeric_limits<std::uint8_t>::max();
constexpr int kCoarsestLevel = LikelihoodPyramid::kLevels - 1;
constexpr int kFinestLevel = LikelihoodWindow::kBlockLevel;  // Of these all offsets are tried.
constexpr double kFarthest_m = 100.0;  // Points beyond would make a search cost memory for nothing.

int SideOf(int level) { return 1 << LikelihoodTile::ShiftOf(level); }

// A square block of cell offsets at one heading, as wide as a cell of its level.
struct Block {
  double bound = 0.0;
  int heading = 0;
  int x = 0;
  int y = 0;
  int level = kFinestLevel;

  bool operator<(const Block& other) const { return bound < other.bound; }
};

double DistanceToInterval(double value, double low, double high) {
  return std::max({0.0, low - value, value - high});
}

// Where the parabola through three values, one apart, is highest, seen from the middle one.
double PeakOf(int before, int middle, int after) {
  const int curvature = 2 * middle - before - after;
  return curvature > 0 ? std::clamp(0.5 * (after - before) / curvature, -0.5, 0.5) : 0.0;
}

// What a squared sigma away from the prediction costs, in units of the score. The score is a mean
// over the points, so that one that misses costs 1 / points; as many as are independent count.
double CostOfSquaredSigma(std::size_t points, const CorrelativeSearchOptions& options) {
  const auto independent = static_cast<std::size_t>(options.independent_points);
  return options.prior_cost_points / static_cast<double>(std::min(points, independent));
}

// The cost of the prior: what it takes off the score of a pose to differ from the prediction.
class PriorCost {
 public:
  PriorCost(const Eigen::Matrix3d& covariance, double per_squared_sigma)
      : information_(per_squared_sigma * covariance.inverse()) {
    const Eigen::Matrix2d of_position = information_.topLeftCorner<2, 2>();
    const Eigen::Vector2d cross = information_.topRightCorner<2, 1>();
    cheapest_per_rad_ = -of_position.inverse() * cross;
    of_heading_ = information_(2, 2) + cross.dot(cheapest_per_rad_);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
    axes.computeDirect(of_position, Eigen::EigenvaluesOnly);
    least_of_position_ = std::max(0.0, axes.eigenvalues()(0));
  }

  double Of(const Eigen::Vector3d& way) const { return way.dot(information_ * way); }

  // A lower bound for the ways to a square of positions with one heading.
  double AtLeast(const Eigen::Vector2d& corner_m, double side_m, double turn_rad) const {
    const Eigen::Vector2d cheapest_m = turn_rad * cheapest_per_rad_;
    const double x_m = DistanceToInterval(cheapest_m.x(), corner_m.x(), corner_m.x() + side_m);
    const double y_m = DistanceToInterval(cheapest_m.y(), corner_m.y(), corner_m.y() + side_m);
    return of_heading_ * turn_rad * turn_rad + least_of_position_ * (x_m * x_m + y_m * y_m);
  }

 private:
  Eigen::Matrix3d information_;
  // With the heading given, the cost is least at a position in proportion to it, and grows with
  // the distance from there by least_of_position_ or more.
  Eigen::Vector2d cheapest_per_rad_;
  double of_heading_ = 0.0;
  double least_of_position_ = 0.0;
};

// The cells the beams end in when the robot stands at the prediction, at headings about it.
class BeamEnds {
 public:
  BeamEnds(const LikelihoodPyramid& map,
           std::span<const Eigen::Vector2d> points_robot_m,
           const SearchWindow& window,
           double max_lever_m)
      : points_(points_robot_m.size()) {
    double lever_m = 1.0;
    for (const Eigen::Vector2d& p : points_robot_m) lever_m = std::max(lever_m, p.norm());
    step_rad_ = map.cell_size_m() / std::min(lever_m, max_lever_m);
    headings_ = static_cast<int>(std::ceil(window.rotation_rad / step_rad_));
    cells_.resize(points_ * static_cast<std::size_t>(2 * headings_ + 1));
    auto cell = cells_.begin();
    const Pose2& center = window.predicted.T_a_b;
    for (int heading = -headings_; heading <= headings_; ++heading) {
      const RigidTransform2 turned({center.x_m, center.y_m, center.theta_rad + TurnOf(heading)});
      for (const Eigen::Vector2d& p_robot : points_robot_m) *cell++ = map.CellAt(turned * p_robot);
    }
  }

  // Headings -last_heading() .. last_heading() are known.
  int last_heading() const { return headings_; }
  double TurnOf(int heading) const { return heading * step_rad_; }
  std::span<const GridCell> At(int heading) const {
    return std::span(cells_).subspan(static_cast<std::size_t>(heading + headings_) * points_,
                                     points_);
  }

  // What of the map they meet when moved by first .. last cells in x and y.
  LikelihoodWindow WindowOf(const LikelihoodPyramid& map,
                            int first,
                            int last,
                            std::uint8_t max_drift_code) const {
    GridCell low = cells_.front();
    GridCell high = low;
    for (const GridCell& cell : cells_) {
      low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
    }
    return {map, {low.x + first, low.y + first}, {high.x + last, high.y + last}, max_drift_code};
  }

 private:
  std::size_t points_;
  double step_rad_ = 0.0;  // Moves a far point by a cell.
  int headings_ = 0;
  std::vector<GridCell> cells_;  // One heading after the other.
};

// Offsets -reach .. reach in x and y, and the blocks the search of them begins with.
struct OffsetRange {
  explicit OffsetRange(int reach_cells) : reach(reach_cells) {
    while (level < kCoarsestLevel && side() < 2 * reach + 1) ++level;
  }

  bool IsOneBlock() const { return level == kFinestLevel && side() > 2 * reach; }

  int side() const { return SideOf(level); }
  int first() const { return -reach; }
  int last() const { return first() + (2 * reach / side() + 1) * side() - 1; }

  int reach;
  int level = kFinestLevel;
};

class BranchAndBound {
 public:
  BranchAndBound(const LikelihoodPyramid& map,
                 std::span<const Eigen::Vector2d> points_robot_m,
                 const SearchWindow& window,
                 const CorrelativeSearchOptions& options)
      : cell_m_(map.cell_size_m()),
        window_(window),
        offsets_(static_cast<int>(std::ceil(window.translation_m / cell_m_))),
        ends_(map, points_robot_m, window, options.lever_m),
        likelihoods_(
            ends_.WindowOf(map, offsets_.first() - 1, offsets_.last() + 1, window.max_drift_code)),
        prior_cost_(window.predicted.covariance,
                    CostOfSquaredSigma(points_robot_m.size(), options)),
        floor_(window.min_score) {}

  std::optional<FoundPose> Run() {
    // From the prediction to either side: it is often hard to beat.
    for (int turn = 0; turn <= ends_.last_heading(); ++turn) {
      PushAll(turn);
      if (turn > 0) PushAll(-turn);
    }
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end());
      const Block best = queue_.back();
      queue_.pop_back();
      if (best.bound <= floor_) break;
      if (best.level == kFinestLevel) {
        TryAll(best);
      } else {
        PushChildren(best);
      }
    }
    if (!best_) return std::nullopt;
    return FoundPose{Refined(*best_), floor_};
  }

 private:
  // Mean likelihood of the beam ends in the block; any lower value once `needed` is out of reach.
  double Score(const Block& block, double needed) const {
    constexpr std::size_t kStride = 16;  // Points after which to ask whether to go on.
    std::span<const GridCell> ends = ends_.At(block.heading);
    const double full = kFullLikelihood * static_cast<double>(ends.size());
    const auto needed_sum = static_cast<int>(needed * full);
    int sum = 0;
    while (!ends.empty()) {
      const auto next = ends.first(std::min(ends.size(), kStride));
      ends = ends.subspan(next.size());
      sum += likelihoods_.Bound(block.level, next, {block.x, block.y});
      if (sum + kFullLikelihood * static_cast<int>(ends.size()) < needed_sum) break;
    }
    return sum / full;
  }

  double LeastCost(const Block& block) const {
    const Eigen::Vector2d way_m = cell_m_ * Eigen::Vector2d(block.x, block.y);
    return prior_cost_.AtLeast(
        way_m, cell_m_ * (SideOf(block.level) - 1), ends_.TurnOf(block.heading));
  }

  // The blocks of a heading. A window of one block needs no bounds.
  void PushAll(int heading) {
    if (offsets_.IsOneBlock()) {
      return TryAll({1.0, heading, offsets_.first(), offsets_.first(), kFinestLevel});
    }
    for (int x = offsets_.first(); x <= offsets_.reach; x += offsets_.side()) {
      for (int y = offsets_.first(); y <= offsets_.reach; y += offsets_.side()) {
        Push({0.0, heading, x, y, offsets_.level});
      }
    }
  }

  void Push(Block block) {
    const double cost = LeastCost(block);
    if (1.0 - cost <= floor_) return;
    block.bound = Score(block, floor_ + cost) - cost;
    if (block.bound <= floor_) return;
    queue_.push_back(block);
    std::push_heap(queue_.begin(), queue_.end());
  }

  void PushChildren(const Block& block) {
    const int level = block.level - 1;
    const int end_x = std::min(block.x + SideOf(block.level), offsets_.reach + 1);
    const int end_y = std::min(block.y + SideOf(block.level), offsets_.reach + 1);
    for (int x = block.x; x < end_x; x += SideOf(level)) {
      for (int y = block.y; y < end_y; y += SideOf(level)) {
        Push({0.0, block.heading, x, y, level});
      }
    }
  }

  // Tries every offset of a block.
  void TryAll(const Block& block) {
    if (1.0 - LeastCost(block) <= floor_) return;
    constexpr int kSide = LikelihoodWindow::kBlockSide;
    const std::span<const GridCell> ends = ends_.At(block.heading);
    const int rows = std::min(kSide, offsets_.reach - block.y + 1);
    const int columns = std::min(kSide, offsets_.reach - block.x + 1);
    const auto sums = likelihoods_.SumsOfBlock(ends, {block.x, block.y}, rows);
    const double full = kFullLikelihood * static_cast<double>(ends.size());
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const double likelihood = sums[static_cast<std::size_t>(y * kSide + x)] / full;
        if (likelihood > floor_) Try(likelihood, {1.0, block.heading, block.x + x, block.y + y, 0});
      }
    }
  }

  void Try(double likelihood, const Block& pose) {
    const double turn_rad = ends_.TurnOf(pose.heading);
    const double score =
        likelihood - prior_cost_.Of({cell_m_ * pose.x, cell_m_ * pose.y, turn_rad});
    if (score <= floor_ || IsExcluded(pose)) return;
    floor_ = score;  // No worse pose will be the best.
    best_ = pose;
  }

  bool IsExcluded(const Block& pose) const {
    if (!window_.exclude) return false;
    const Eigen::Vector2d way_m = PoseOf(pose).translation_m() - window_.exclude->translation_m();
    return way_m.norm() <= window_.exclude_m;
  }

  // Between the cells, by parabolas through the best one and its neighbours along x and y.
  Pose2 Refined(const Block& best) const {
    const auto sums = likelihoods_.SumsOfBlock(ends_.At(best.heading), {best.x - 1, best.y - 1}, 3);
    const auto sum_beside = [&sums](int x, int y) {
      return sums[static_cast<std::size_t>((y + 1) * LikelihoodWindow::kBlockSide + x + 1)];
    };
    Pose2 refined = PoseOf(best);
    refined.x_m += cell_m_ * PeakOf(sum_beside(-1, 0), sum_beside(0, 0), sum_beside(1, 0));
    refined.y_m += cell_m_ * PeakOf(sum_beside(0, -1), sum_beside(0, 0), sum_beside(0, 1));
    return refined;
  }

  Pose2 PoseOf(const Block& block) const {
    const Pose2& center = window_.predicted.T_a_b;
    return {center.x_m + block.x * cell_m_,
            center.y_m + block.y * cell_m_,
            NormalizeAngle(center.theta_rad + ends_.TurnOf(block.heading))};
  }

  double cell_m_;
  const SearchWindow& window_;
  OffsetRange offsets_;
  BeamEnds ends_;
  LikelihoodWindow likelihoods_;
  PriorCost prior_cost_;
  double floor_;  // Score of the best pose met so far.
  std::optional<Block> best_;
  std::vector<Block> queue_;  // A heap, the highest bound first.
};

}  // namespace

std::optional<FoundPose> SearchPose(const LikelihoodPyramid& map,
                                    std::span<const Eigen::Vector2d> points_robot_m,
                                    const SearchWindow& window,
                                    const CorrelativeSearchOptions& options) {
  std::vector<Eigen::Vector2d> near_robot_m;
  std::ranges::copy_if(points_robot_m,
                       std::back_inserter(near_robot_m),
                       [](const Eigen::Vector2d& p) { return p.norm() < kFarthest_m; });
  if (near_robot_m.empty()) return std::nullopt;
  return BranchAndBound(map, near_robot_m, window, options).Run();
}

}  // namespace qwsm
