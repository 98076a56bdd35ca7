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
constexpr double kFarthest_m = 100.0;  // Points beyond would make a search cost memory for nothing.

// A square block of 2^level x 2^level cell offsets at one heading.
struct Block {
  double bound = 0.0;
  int heading = 0;
  int x = 0;
  int y = 0;
  int level = 0;

  bool operator<(const Block& other) const { return bound < other.bound; }
};

double DistanceToInterval(double value, double low, double high) {
  return std::max({0.0, low - value, value - high});
}

// In units of the score, which is a mean over the points.
double PriceOfSquaredSigma(std::size_t points, const CorrelativeSearchOptions& options) {
  const auto independent = static_cast<std::size_t>(options.independent_points);
  return options.prior_points / static_cast<double>(std::min(points, independent));
}

// What the way from the prediction costs, in units of the score.
class PriceList {
 public:
  PriceList(const Eigen::Matrix3d& covariance, double per_squared_sigma)
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
  // With the heading given, the price is least at a position in proportion to it, and grows with
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
    cells_.reserve(points_ * static_cast<std::size_t>(2 * headings_ + 1));
    const Pose2& center = window.predicted.T_a_b;
    for (int heading = -headings_; heading <= headings_; ++heading) {
      const Pose2 turned{center.x_m, center.y_m, center.theta_rad + TurnOf(heading)};
      const Eigen::Matrix2d R = turned.Rotation();
      for (const Eigen::Vector2d& p_robot : points_robot_m) {
        const Eigen::Vector2d p_map = R * p_robot + turned.translation_m();
        cells_.push_back({map.CellIndex(p_map.x()), map.CellIndex(p_map.y())});
      }
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

// Offsets -reach .. reach in x and y, and the blocks the search of them begins with. Blocks begin
// at multiples of their side.
struct OffsetRange {
  explicit OffsetRange(int reach_cells) : reach(reach_cells) {
    while (level < kCoarsestLevel && side() < 2 * reach + 1) ++level;
  }

  int side() const { return 1 << level; }
  int first() const { return -reach & -side(); }
  int last() const { return reach | (side() - 1); }

  int reach;
  int level = 0;
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
        likelihoods_(ends_.WindowOf(map, offsets_.first(), offsets_.last(), window.max_drift_code)),
        prices_(window.predicted.covariance, PriceOfSquaredSigma(points_robot_m.size(), options)),
        floor_(window.min_score) {}

  std::optional<FoundPose> Run() {
    Push({0.0, 0, 0, 0, 0});  // The prediction itself is often hard to beat.
    for (int heading = -ends_.last_heading(); heading <= ends_.last_heading(); ++heading) {
      for (int x = offsets_.first(); x <= offsets_.reach; x += offsets_.side()) {
        for (int y = offsets_.first(); y <= offsets_.reach; y += offsets_.side()) {
          Push({0.0, heading, x, y, offsets_.level});
        }
      }
    }
    while (!queue_.empty()) {
      std::pop_heap(queue_.begin(), queue_.end());
      const Block best = queue_.back();
      queue_.pop_back();
      if (best.level == 0) return FoundPose{PoseOf(best), best.bound};
      PushChildren(best);
    }
    return std::nullopt;
  }

 private:
  // Mean likelihood of the beam ends in the block; any lower value once `needed` is out of reach.
  double Score(const Block& block, double needed) const {
    constexpr std::size_t kStride = 16;  // Points between two looks at whether to go on.
    std::span<const GridCell> ends = ends_.At(block.heading);
    const double full = kFullLikelihood * static_cast<double>(ends.size());
    const auto needed_sum = static_cast<int>(needed * full);
    int sum = 0;
    while (!ends.empty()) {
      const auto next = ends.first(std::min(ends.size(), kStride));
      ends = ends.subspan(next.size());
      sum += likelihoods_.Sum(block.level, next, {block.x, block.y});
      if (sum + kFullLikelihood * static_cast<int>(ends.size()) < needed_sum) break;
    }
    return sum / full;
  }

  double Price(const Block& block) const {
    const Eigen::Vector2d way_m = cell_m_ * Eigen::Vector2d(block.x, block.y);
    const double turn_rad = ends_.TurnOf(block.heading);
    if (block.level == 0) return prices_.Of({way_m.x(), way_m.y(), turn_rad});
    return prices_.AtLeast(way_m, cell_m_ * ((1 << block.level) - 1), turn_rad);
  }

  void Push(Block block) {
    if (IsExcluded(block)) return;
    const double price = Price(block);
    if (1.0 - price < floor_) return;
    block.bound = Score(block, floor_ + price) - price;
    if (block.bound <= window_.min_score || block.bound < floor_) return;
    if (block.level == 0) floor_ = block.bound;  // No worse pose will be the best.
    queue_.push_back(block);
    std::push_heap(queue_.begin(), queue_.end());
  }

  bool IsExcluded(const Block& block) const {
    if (!window_.exclude || block.level > 0) return false;
    const Eigen::Vector2d way_m = PoseOf(block).translation_m() - window_.exclude->translation_m();
    return way_m.norm() <= window_.exclude_m;
  }

  void PushChildren(const Block& block) {
    const int level = block.level - 1;
    const int side = 1 << level;
    const auto is_inside = [&](int first) {
      return first <= offsets_.reach && first + side > -offsets_.reach;
    };
    for (const int x : {block.x, block.x + side}) {
      for (const int y : {block.y, block.y + side}) {
        if (is_inside(x) && is_inside(y)) Push({0.0, block.heading, x, y, level});
      }
    }
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
  PriceList prices_;
  double floor_;              // The best single pose met so far.
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
