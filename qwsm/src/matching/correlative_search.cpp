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
        reach_(CellsIn(window.translation_m)),
        searched_(window.searched ? std::min(reach_, CellsIn(window.searched->translation_m)) : 0),
        ends_(map, points_robot_m, window, options.lever_m, memory_),
        likelihoods_(map, CellsRead(), window.max_drift_code, memory_),
        prior_cost_(window.predicted.covariance,
                    CostOfSquaredSigma(points_robot_m.size(), options)),
        beams_(memory_.Take<LikelihoodWindow::Bounds>(ends_.count())) {}

  // The root of the highest bound is visited first, until none can hold a better pose.
  std::optional<FoundPose> Best(double min_score, const std::optional<ExcludedDisk>& excluded) {
    floor_ = min_score;
    excluded_ = excluded;
    best_.reset();
    if (floor_ < floor_of_roots_) FindRoots();
    queue_.clear();
    std::ranges::copy_if(roots_, std::back_inserter(queue_), [this](const SearchBlock& root) {
      return root.bound > floor_ && !IsExcluded(root);
    });
    std::make_heap(queue_.begin(), queue_.end());
    while (!queue_.empty() && queue_.front().bound > floor_) {
      std::pop_heap(queue_.begin(), queue_.end());
      Visit(queue_.back());
      queue_.pop_back();
    }
    if (!best_) return std::nullopt;
    return FoundPose{Refined(*best_), floor_};
  }

 private:
  static constexpr int kSide = LikelihoodWindow::kBlockSide;
  // As many blocks along each axis as pairs by pairs of offsets are bounded at once.
  static constexpr int kBlocksOfRoot =
      LikelihoodWindow::kBlocks * LikelihoodWindow::kPairSide / LikelihoodWindow::kBlockSide;

  int CellsIn(double length_m) const { return static_cast<int>(std::ceil(length_m / cell_m_)); }

  // Blocks may begin before the first offset and end behind the last one.
  CellBox CellsRead() const {
    const CellBox ends = ends_.Extent();
    const int beyond = reach_ + kSide;
    return {.low = {ends.low.x - beyond, ends.low.y - beyond},
            .high = {ends.high.x + beyond, ends.high.y + beyond}};
  }

  // The blocks that may hold a pose better than wanted now: later searches mostly want more.
  void FindRoots() {
    roots_.clear();
    floor_of_roots_ = floor_;
    const std::array<OffsetArea, 1> all = {AllOffsets()};
    const std::array<OffsetArea, 4> around = OffsetsAroundSearched();
    for (const HeadingGroup& group : ends_.groups()) {
      for (const OffsetArea& area :
           group.was_searched ? std::span<const OffsetArea>(around) : all) {
        AddRootsOf(group, area);
      }
    }
  }

  OffsetArea AllOffsets() const {
    const int blocks = 2 * reach_ / kSide + 1;
    return {.first = {-reach_, -reach_}, .columns = blocks, .rows = blocks};
  }

  // Those before, behind, above and below the ones that were searched with the same headings.
  std::array<OffsetArea, 4> OffsetsAroundSearched() const {
    const int all = AllOffsets().rows;
    const int beside = (reach_ - searched_ + kSide - 1) / kSide;
    const int across = 2 * searched_ / kSide + 1;
    const int before = -searched_ - beside * kSide;
    const int behind = searched_ + 1;
    return {{{.first = {before, -reach_}, .columns = beside, .rows = all},
             {.first = {behind, -reach_}, .columns = beside, .rows = all},
             {.first = {-searched_, before}, .columns = across, .rows = beside},
             {.first = {-searched_, behind}, .columns = across, .rows = beside}}};
  }

  // Of a group of headings, as many blocks at a time as are bounded at once.
  void AddRootsOf(const HeadingGroup& group, const OffsetArea& area) {
    constexpr int kAtOnce = LikelihoodWindow::kBlocks;
    const auto places = likelihoods_.PlacesOf(group.beam_ends, area.first);
    for (int row = 0; row < area.rows; row += kAtOnce) {
      for (int column = 0; column < area.columns; column += kAtOnce) {
        likelihoods_.BoundsOf(places, {column / kAtOnce, row / kAtOnce}, beams_);
        AddRoots(group.headings,
                 {.first = {area.first.x + column * kSide, area.first.y + row * kSide},
                  .columns = std::min(kAtOnce, area.columns - column),
                  .rows = std::min(kAtOnce, area.rows - row)});
      }
    }
  }

  void AddRoots(HeadingRange headings, const OffsetArea& area) {
    const auto sums = LikelihoodWindow::SumsOf(beams_, area.rows);
    const std::size_t before = roots_.size();
    for (int row = 0; row < area.rows; row += kBlocksOfRoot) {
      for (int column = 0; column < area.columns; column += kBlocksOfRoot) {
        AddRoot({.headings = headings,
                 .first = {area.first.x + column * kSide, area.first.y + row * kSide},
                 .side = kBlocksOfRoot * kSide,
                 .beams = beams_,
                 .blocks = {.column = column,
                            .row = row,
                            .columns = std::min(kBlocksOfRoot, area.columns - column),
                            .rows = std::min(kBlocksOfRoot, area.rows - row)}},
                sums);
      }
    }
    // The bounds of the next area are kept beside those of this one where roots look at these.
    if (roots_.size() > before) beams_ = memory_.Take<LikelihoodWindow::Bounds>(ends_.count());
  }

  // Those blocks of a root that may hold a better pose, if they are few; else the root.
  // @param sums of the bounds of all beams.
  void AddRoot(SearchBlock root, const LikelihoodWindow::BlockSums& sums) {
    constexpr std::size_t kFew = 4;
    const std::size_t before = roots_.size();
    const auto [first_column, first_row, columns, rows] = root.blocks;
    const int needed = NeededSum(0.0);
    for (int row = first_row; row < first_row + rows; ++row) {
      for (int column = first_column; column < first_column + columns; ++column) {
        const int sum = sums[static_cast<std::size_t>(row * LikelihoodWindow::kBlocks + column)];
        if (sum < needed) continue;
        SearchBlock block{.headings = root.headings,
                          .first = {root.first.x + (column - first_column) * kSide,
                                    root.first.y + (row - first_row) * kSide},
                          .side = kSide,
                          .beams = root.beams,
                          .blocks = {.column = column, .row = row}};
        block.bound = sum / Full() - LeastCost(block);
        if (block.bound <= floor_) continue;
        root.bound = std::max(root.bound, block.bound);
        roots_.push_back(block);
      }
    }
    if (roots_.size() - before <= kFew) return;
    roots_.resize(before);
    roots_.push_back(root);
  }

  // Tries the offsets of a root at each of its headings.
  void Visit(const SearchBlock& root) {
    FindRests(root);
    const double least_cost = LeastCost(root);
    SearchBlock at_heading = root;
    for (int heading = root.headings.first; heading <= root.headings.last; ++heading) {
      if (root.bound <= floor_) return;
      at_heading.headings = {heading, heading};
      const int needed = NeededSum(least_cost);
      root.side == kSide ? TryBlock(at_heading, needed) : TryPairs(at_heading, needed);
    }
  }

  // Tries each offset of a single block.
  void TryBlock(const SearchBlock& block, int needed) {
    const auto sums = likelihoods_.SumsOfBlock(
        ends_.At(block.headings.first), block.first, {.needed = needed, .rest = rests_});
    auto sum = sums.begin();
    for (int y = block.first.y; y < block.first.y + kSide; ++y) {
      for (int x = block.first.x; x < block.first.x + kSide; ++x, ++sum) {
        if (*sum >= needed) Try(*sum, {.headings = block.headings, .first = {x, y}});
      }
    }
  }

  // Tries those squares of two offsets by two of a root that may hold a better pose, the one of
  // the highest bound first: a good pose soon makes most of what follows needless.
  void TryPairs(const SearchBlock& root, int needed) {
    constexpr int kPairSide = LikelihoodWindow::kPairSide;
    const auto cells = ends_.At(root.headings.first);
    FindPairs(root, needed);
    for (const SearchBlock& pair : pairs_) {
      if (pair.bound <= floor_) break;
      const auto sums = likelihoods_.SumsOfPair(cells, pair.first);
      auto sum = sums.begin();
      for (int y = pair.first.y; y < pair.first.y + kPairSide; ++y) {
        for (int x = pair.first.x; x < pair.first.x + kPairSide; ++x, ++sum) {
          Try(*sum, {.headings = pair.headings, .first = {x, y}});
        }
      }
    }
  }

  // The highest bound first.
  void FindPairs(const SearchBlock& root, int needed) {
    constexpr int kPairSide = LikelihoodWindow::kPairSide;
    const auto bounds = likelihoods_.BoundsOfPairs(
        ends_.At(root.headings.first),
        root.first,
        {.needed = needed, .rest = rests_, .rows = root.blocks.rows * kSide / kPairSide});
    pairs_.clear();
    auto bound = bounds.begin();
    for (int y = root.first.y; y < root.first.y + root.side; y += kPairSide) {
      for (int x = root.first.x; x < root.first.x + root.side; x += kPairSide, ++bound) {
        if (*bound < needed || x > reach_ || y > reach_) continue;
        SearchBlock pair{.headings = root.headings, .first = {x, y}, .side = kPairSide};
        pair.bound = *bound / Full() - LeastCost(pair);
        if (pair.bound > floor_ && !IsExcluded(pair)) pairs_.push_back(pair);
      }
    }
    std::sort(pairs_.rbegin(), pairs_.rend());
  }

  // Bounds what all beams but the first few bring, all but twice as many .., in a block of a root.
  void FindRests(const SearchBlock& root) {
    constexpr std::size_t kAtATime = LikelihoodWindow::kCellsAtATime;
    const auto [first_column, first_row, columns, rows] = root.blocks;
    auto beams = root.beams;
    rests_.assign((beams.size() + kAtATime - 1) / kAtATime, 0);
    LikelihoodWindow::BlockSums rest{};
    for (std::size_t part = rests_.size(); part-- > 1;) {
      const auto of_part = beams.subspan(part * kAtATime);
      beams = beams.first(part * kAtATime);
      if (root.side == kSide) {
        for (const auto& beam : of_part) rest.front() += beam.At(first_column, first_row);
        rests_[part - 1] = rest.front();
        continue;
      }
      const auto sums = LikelihoodWindow::SumsOf(of_part, first_row + rows);
      for (int row = first_row; row < first_row + rows; ++row) {
        for (int column = first_column; column < first_column + columns; ++column) {
          const auto block = static_cast<std::size_t>(row * LikelihoodWindow::kBlocks + column);
          rest[block] += sums[block];
          rests_[part - 1] = std::max(rests_[part - 1], rest[block]);
        }
      }
    }
  }

  // Sum of likelihoods without which no pose of that cost is the best.
  int NeededSum(double cost) const { return static_cast<int>((floor_ + cost) * Full()); }

  double LeastCost(const SearchBlock& block) const {
    const Eigen::Vector2d way_m = cell_m_ * Eigen::Vector2d(block.first.x, block.first.y);
    return prior_cost_.AtLeast(way_m,
                               cell_m_ * (block.side - 1),
                               ends_.TurnOf(block.headings.first),
                               ends_.TurnOf(block.headings.last));
  }

  // @param sum of the likelihoods at a pose.
  void Try(int sum, const SearchBlock& pose) {
    const double likelihood = sum / Full();
    if (likelihood <= floor_) return;
    if (std::abs(pose.first.x) > reach_ || std::abs(pose.first.y) > reach_) return;
    const double turn_rad = ends_.TurnOf(pose.headings.first);
    const double score =
        likelihood - prior_cost_.Of({cell_m_ * pose.first.x, cell_m_ * pose.first.y, turn_rad});
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
    const auto cells = ends_.At(best.headings.first);
    const auto left = likelihoods_.SumsOfPair(cells, {best.first.x - 1, best.first.y});
    const auto above = likelihoods_.SumsOfPair(cells, {best.first.x, best.first.y - 1});
    Pose2 refined = PoseOf(best);
    refined.x_m += cell_m_ * PeakOf(left[0], left[1], above[3]);
    refined.y_m += cell_m_ * PeakOf(above[0], above[2], left[3]);
    return refined;
  }

  Pose2 PoseOf(const SearchBlock& block) const {
    return {center_.x_m + block.first.x * cell_m_,
            center_.y_m + block.first.y * cell_m_,
            NormalizeAngle(center_.theta_rad + ends_.TurnOf(block.headings.first))};
  }

  // Sum of the likelihoods where every beam ends on a surface.
  double Full() const { return kFullLikelihood * static_cast<double>(ends_.count()); }

  SearchMemory memory_;
  double cell_m_;
  Pose2 center_;
  int reach_;     // Offsets are up to that far from 0 along both axes, in cells.
  int searched_;  // Those up to so far were searched before, at some headings.
  BeamEnds ends_;
  LikelihoodWindow likelihoods_;
  PriorCost prior_cost_;
  std::span<LikelihoodWindow::Bounds> beams_;  // Of all beams in the area being looked at.
  std::vector<SearchBlock> roots_;             // Those with bounds above the floor below.
  double floor_of_roots_ = std::numeric_limits<double>::infinity();
  std::optional<ExcludedDisk> excluded_;
  double floor_ = 0.0;  // Score of the best pose met so far.
  std::optional<SearchBlock> best_;
  std::vector<SearchBlock> queue_;  // A heap of roots, the highest bound first.
  std::vector<int> rests_;          // Of the root being visited.
  std::vector<SearchBlock> pairs_;  // Of the same at one heading.
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
