// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/correlative_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

#include "beam_ends.hpp"
#include "prior_cost.hpp"
#include "qwsm/search/likelihood_window.hpp"
#include "search_block.hpp"

namespace qwsm {
namespace {

constexpr int kFullLikelihood = std::numeric_limits<std::uint8_t>::max();
constexpr double kFarthest_m = 100.0;  // Points beyond would make a search cost memory for nothing.

// Where the parabola through three values, one apart, is highest, seen from the middle one.
double PeakOf(int before, int middle, int after) {
  const int curvature = 2 * middle - before - after;
  return curvature > 0 ? std::clamp(0.5 * (after - before) / curvature, -0.5, 0.5) : 0.0;
}

}  // namespace

class PoseSearch::BranchAndBound {
 public:
  BranchAndBound(const LikelihoodPyramid& map,
                 std::span<const Eigen::Vector2d> points_robot_m,
                 const SearchWindow& window,
                 const CorrelativeSearchOptions& options)
      : cell_m_(map.cell_size_m()),
        center_(window.predicted.T_a_b),
        offsets_(static_cast<int>(std::ceil(window.translation_m / cell_m_))),
        ends_(map, points_robot_m, window, options.lever_m),
        likelihoods_(
            ends_.WindowOf(map, offsets_.first() - 1, offsets_.last() + 1, window.max_drift_code)),
        prior_cost_(window.predicted.covariance,
                    CostOfSquaredSigma(points_robot_m.size(), options)) {}

  std::optional<FoundPose> Best(double min_score, const std::optional<ExcludedDisk>& excluded) {
    floor_ = min_score;
    excluded_ = excluded;
    best_.reset();
    offsets_.IsOneBlock() ? TryHeadings() : BranchFromWindow();
    if (!best_) return std::nullopt;
    return FoundPose{Refined(*best_), floor_};
  }

 private:
  // All offsets of a heading are tried at once.
  void TryHeadings() {
    constexpr int kSide = LikelihoodWindow::kBlockSide;
    ForEachHeading([this](int heading) {
      SearchBlock block{0.0, heading, offsets_.first(), offsets_.first(), kSide};
      const double cost = LeastCost(block);
      const int bound =
          likelihoods_.Bound(LikelihoodWindow::kBlockLevel, ends_.At(heading), {block.x, block.y});
      if (bound / Full() - cost <= floor_) return;
      const auto sums = likelihoods_.SumsOfBlock(
          ends_.At(heading),
          {block.x, block.y},
          {.bound = bound, .needed = NeededSum(cost), .rows = 2 * offsets_.reach + 1});
      TryAll(block, sums);
    });
  }

  // The block of the highest bound is visited first, until none can hold a better pose.
  void BranchFromWindow() {
    if (floor_ < floor_of_roots_) FindRoots();
    queue_.clear();
    std::ranges::copy_if(roots_, std::back_inserter(queue_), [this](const SearchBlock& root) {
      return root.bound > floor_ && !IsExcluded(root);
    });
    std::make_heap(queue_.begin(), queue_.end());
    while (!queue_.empty() && queue_.front().bound > floor_) {
      std::pop_heap(queue_.begin(), queue_.end());
      TryPairs(queue_.back());
      queue_.pop_back();
    }
  }

  // From the prediction to either side: it is often hard to beat.
  template <class Visit>
  void ForEachHeading(Visit visit) const {
    for (int turn = 0; turn <= ends_.last_heading(); ++turn) {
      visit(turn);
      if (turn > 0) visit(-turn);
    }
  }

  // The blocks that may hold a pose better than wanted now: later searches mostly want more.
  void FindRoots() {
    roots_.clear();
    floor_of_roots_ = floor_;
    ForEachHeading([this](int heading) { AddRoots(heading); });
  }

  // Those of a heading. Their bounds are by the finer blocks that each consists of: many of these
  // are bounded at once, and most roots are not worth looking into further.
  void AddRoots(int heading) {
    constexpr int kBlocks = LikelihoodWindow::kBlockSide;  // Bounded at once, along each axis.
    constexpr int kSide = LikelihoodWindow::kBlockSide;    // Of each.
    for (int y = offsets_.first(); y <= offsets_.reach; y += kBlocks * kSide) {
      for (int x = offsets_.first(); x <= offsets_.reach; x += kBlocks * kSide) {
        const auto bounds =
            likelihoods_.BoundsOfBlocks(LikelihoodWindow::kBlockLevel, ends_.At(heading), {x, y});
        for (int row = 0; row < kBlocks; row += kBlocksOfRoot) {
          for (int column = 0; column < kBlocks; column += kBlocksOfRoot) {
            AddRoot({0.0, heading, x + column * kSide, y + row * kSide, kRootSide},
                    &bounds[static_cast<std::size_t>(row * kBlocks + column)]);
          }
        }
      }
    }
  }

  // @param bounds of its first block, in rows of LikelihoodWindow::kBlockSide.
  void AddRoot(SearchBlock root, const int* bounds) {
    static_assert(kBlocksOfRoot == 2);
    constexpr int kBelow = LikelihoodWindow::kBlockSide;
    const int bound = std::max({bounds[0], bounds[1], bounds[kBelow], bounds[kBelow + 1]});
    if (bound < NeededSum(0.0) || root.x > offsets_.reach || root.y > offsets_.reach) return;
    root.bound = bound / Full() - LeastCost(root);
    if (root.bound > floor_) roots_.push_back(root);
  }

  // Tries those squares of two offsets by two of a block that may hold a better pose, the one of
  // the highest bound first: a good pose soon makes most of what follows needless.
  void TryPairs(const SearchBlock& block) {
    const LikelihoodWindow::Hope hope{
        .bound = likelihoods_.Bound(kRootLevel, ends_.At(block.heading), {block.x, block.y}),
        .needed = NeededSum(LeastCost(block))};
    const auto bounds =
        likelihoods_.BoundsOfPairs(ends_.At(block.heading), {block.x, block.y}, hope);
    pairs_.clear();
    AddParts(bounds,
             hope.needed,
             {0.0, block.heading, block.x, block.y, LikelihoodWindow::kPairSide},
             [this](const SearchBlock& pair) {
               if (pair.bound > floor_ && !IsExcluded(pair)) pairs_.push_back(pair);
             });
    std::sort(pairs_.rbegin(), pairs_.rend());
    for (const SearchBlock& pair : pairs_) {
      if (pair.bound <= floor_) break;
      TryAll(pair, likelihoods_.SumsOfPair(ends_.At(pair.heading), {pair.x, pair.y}));
    }
  }

  // Hands on those of many blocks side by side that begin within the window.
  // @param needed those of lower bounds are left out.
  // @param first the first of them; its bound does not count.
  template <class Visit>
  void AddParts(const LikelihoodWindow::BlockSums& bounds,
                int needed,
                const SearchBlock& first,
                Visit visit) {
    constexpr int kAtOnce = LikelihoodWindow::kBlockSide;
    auto bound = bounds.begin();
    for (int y = first.y; y < first.y + kAtOnce * first.side; y += first.side) {
      for (int x = first.x; x < first.x + kAtOnce * first.side; x += first.side, ++bound) {
        if (*bound < needed || x > offsets_.reach || y > offsets_.reach) continue;
        SearchBlock part{*bound / Full(), first.heading, x, y, first.side};
        part.bound -= LeastCost(part);
        visit(part);
      }
    }
  }

  // Sum of likelihoods without which no pose of that cost is the best.
  int NeededSum(double cost) const { return static_cast<int>((floor_ + cost) * Full()); }

  double LeastCost(const SearchBlock& block) const {
    const Eigen::Vector2d way_m = cell_m_ * Eigen::Vector2d(block.x, block.y);
    return prior_cost_.AtLeast(way_m, cell_m_ * (block.side - 1), ends_.TurnOf(block.heading));
  }

  // Tries every offset of a block. @param sums of likelihoods there, row by row.
  template <std::size_t kOffsets>
  void TryAll(const SearchBlock& block, const std::array<int, kOffsets>& sums) {
    auto sum = sums.begin();
    for (int y = block.y; y < block.y + block.side; ++y) {
      for (int x = block.x; x < block.x + block.side; ++x, ++sum) {
        const double likelihood = *sum / Full();
        if (likelihood <= floor_ || x > offsets_.reach || y > offsets_.reach) continue;
        Try(likelihood, {1.0, block.heading, x, y, 1});
      }
    }
  }

  void Try(double likelihood, const SearchBlock& pose) {
    const double turn_rad = ends_.TurnOf(pose.heading);
    const double score =
        likelihood - prior_cost_.Of({cell_m_ * pose.x, cell_m_ * pose.y, turn_rad});
    if (score <= floor_ || IsExcluded(pose)) return;
    floor_ = score;  // No worse pose will be the best.
    best_ = pose;
  }

  // Whether all positions of a block are excluded: those of its corners are, then.
  bool IsExcluded(const SearchBlock& block) const {
    if (!excluded_) return false;
    const Eigen::Vector2d low_m = PoseOf(block).translation_m() - excluded_->center_map_m;
    const double side_m = cell_m_ * (block.side - 1);
    const Eigen::Vector2d high_m = low_m + Eigen::Vector2d::Constant(side_m);
    return low_m.cwiseAbs().cwiseMax(high_m.cwiseAbs()).norm() <= excluded_->radius_m;
  }

  // Between the cells, by parabolas through the best one and its neighbours along x and y.
  Pose2 Refined(const SearchBlock& best) {
    const auto sums =
        likelihoods_.SumsOfBlock(ends_.At(best.heading), {best.x - 1, best.y - 1}, {.rows = 3});
    const auto sum_beside = [&sums](int x, int y) {
      return sums[static_cast<std::size_t>((y + 1) * LikelihoodWindow::kBlockSide + x + 1)];
    };
    Pose2 refined = PoseOf(best);
    refined.x_m += cell_m_ * PeakOf(sum_beside(-1, 0), sum_beside(0, 0), sum_beside(1, 0));
    refined.y_m += cell_m_ * PeakOf(sum_beside(0, -1), sum_beside(0, 0), sum_beside(0, 1));
    return refined;
  }

  Pose2 PoseOf(const SearchBlock& block) const {
    return {center_.x_m + block.x * cell_m_,
            center_.y_m + block.y * cell_m_,
            NormalizeAngle(center_.theta_rad + ends_.TurnOf(block.heading))};
  }

  // Sum of the likelihoods where every beam ends on a surface.
  double Full() const { return kFullLikelihood * static_cast<double>(ends_.count()); }

  double cell_m_;
  Pose2 center_;
  OffsetRange offsets_;
  BeamEnds ends_;
  LikelihoodWindow likelihoods_;
  PriorCost prior_cost_;
  std::vector<SearchBlock> roots_;  // Those with bounds above the floor below.
  double floor_of_roots_ = std::numeric_limits<double>::infinity();
  std::optional<ExcludedDisk> excluded_;
  double floor_ = 0.0;  // Score of the best pose met so far.
  std::optional<SearchBlock> best_;
  std::vector<SearchBlock> queue_;  // A heap of roots, the highest bound first.
  std::vector<SearchBlock> pairs_;  // Of the root being visited.
};

PoseSearch::PoseSearch(const LikelihoodPyramid& map,
                       std::span<const Eigen::Vector2d> points_robot_m,
                       const SearchWindow& window,
                       const CorrelativeSearchOptions& options) {
  std::vector<Eigen::Vector2d> near_robot_m;
  near_robot_m.reserve(points_robot_m.size());
  std::ranges::copy_if(points_robot_m,
                       std::back_inserter(near_robot_m),
                       [](const Eigen::Vector2d& p) { return p.norm() < kFarthest_m; });
  if (near_robot_m.empty()) return;
  search_ = std::make_unique<BranchAndBound>(map, near_robot_m, window, options);
}

PoseSearch::PoseSearch(PoseSearch&&) noexcept = default;
PoseSearch& PoseSearch::operator=(PoseSearch&&) noexcept = default;
PoseSearch::~PoseSearch() = default;

std::optional<FoundPose> PoseSearch::Best(double min_score,
                                          const std::optional<ExcludedDisk>& excluded) {
  return search_ ? search_->Best(min_score, excluded) : std::nullopt;
}

std::optional<FoundPose> SearchPose(const LikelihoodPyramid& map,
                                    std::span<const Eigen::Vector2d> points_robot_m,
                                    const SearchWindow& window,
                                    const CorrelativeSearchOptions& options) {
  return PoseSearch(map, points_robot_m, window, options).Best(window.min_score, window.excluded);
}

}  // namespace qwsm
