// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/correlative_search.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace qwsm {
namespace {

constexpr int kFullLikelihood = std::numeric_limits<std::uint8_t>::max();
constexpr int kCoarsestLevel = LikelihoodPyramid::kLevels - 1;

// A square block of 2^level x 2^level cell offsets at one heading.
struct Block {
  double bound = 0.0;
  int heading = 0;
  int x = 0;
  int y = 0;
  int level = 0;

  bool operator<(const Block& other) const { return bound < other.bound; }
};

struct CellOffset {
  int x = 0;
  int y = 0;
};

// The offset nearest to 0 among first .. first + count - 1.
int NearestToZero(int first, int count) {
  if (first > 0) return first;
  return std::min(0, first + count - 1);
}

// In units of the score, which is a mean over the points.
double PriceOfSquaredSigma(std::size_t points, const CorrelativeSearchOptions& options) {
  const auto independent = static_cast<std::size_t>(options.independent_points);
  return options.prior_points / static_cast<double>(std::min(points, independent));
}

class BranchAndBound {
 public:
  BranchAndBound(const LikelihoodPyramid& map,
                 std::span<const Eigen::Vector2d> points_robot_m,
                 const SearchWindow& window,
                 const CorrelativeSearchOptions& options)
      : map_(map),
        points_robot_m_(points_robot_m),
        window_(window),
        options_(options),
        floor_(window.min_score) {
    double lever_m = 1.0;
    for (const Eigen::Vector2d& p : points_robot_m) lever_m = std::max(lever_m, p.norm());
    heading_step_rad_ = map.cell_size_m() / std::min(lever_m, options.lever_m);
    headings_ = static_cast<int>(std::ceil(window.rotation_rad / heading_step_rad_));
    reach_ = static_cast<int>(std::ceil(window.translation_m / map.cell_size_m()));
    level_ = 0;
    while (level_ < kCoarsestLevel && (1 << level_) < 2 * reach_ + 1) ++level_;
    PricePriors();
    RotatePoints();
  }

  std::optional<FoundPose> Run() {
    Push({0.0, 0, 0, 0, 0});  // The prediction itself is often hard to beat.
    for (int heading = -headings_; heading <= headings_; ++heading) {
      for (int x = -reach_; x <= reach_; x += 1 << level_) {
        for (int y = -reach_; y <= reach_; y += 1 << level_) Push({0.0, heading, x, y, level_});
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
  void PricePriors() {
    information_ = window_.predicted.covariance.inverse();
    price_ = PriceOfSquaredSigma(points_robot_m_.size(), options_);
    // What is left of the price of an offset when the heading is free: a lower bound at any
    // heading.
    const Eigen::Vector2d cross = information_.topRightCorner<2, 1>();
    const Eigen::Matrix2d at_best_heading =
        information_.topLeftCorner<2, 2>() - cross * cross.transpose() / information_(2, 2);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes;
    axes.computeDirect(at_best_heading, Eigen::EigenvaluesOnly);
    cheapest_per_m2_ = std::max(0.0, axes.eigenvalues()(0));
  }

  void RotatePoints() {
    const Pose2& center = window_.predicted.T_a_b;
    cells_.reserve(points_robot_m_.size() * static_cast<std::size_t>(2 * headings_ + 1));
    for (int heading = -headings_; heading <= headings_; ++heading) {
      const Pose2 turned{center.x_m, center.y_m, center.theta_rad + heading * heading_step_rad_};
      const Eigen::Matrix2d R = turned.Rotation();
      for (const Eigen::Vector2d& p_robot : points_robot_m_) {
        const Eigen::Vector2d p_map = R * p_robot + turned.translation_m();
        cells_.push_back({map_.CellIndex(p_map.x()), map_.CellIndex(p_map.y())});
      }
    }
  }

  std::span<const CellOffset> CellsAt(int heading) const {
    const std::size_t count = points_robot_m_.size();
    return std::span(cells_).subspan(static_cast<std::size_t>(heading + headings_) * count, count);
  }

  // Mean likelihood of the beam ends in the block; any lower value once `needed` is out of reach.
  double Score(const Block& block, double needed) const {
    constexpr std::size_t kStride = 16;  // Points between two looks at whether to go on.
    const std::span<const CellOffset> ends = CellsAt(block.heading);
    const double full = kFullLikelihood * static_cast<double>(ends.size());
    const auto needed_sum = static_cast<int>(needed * full);
    int sum = 0;
    for (std::size_t i = 0; i < ends.size(); i += kStride) {
      const std::size_t end = std::min(ends.size(), i + kStride);
      for (std::size_t k = i; k < end; ++k) {
        const LikelihoodPyramid::Cell cell =
            map_.At(block.level, ends[k].x + block.x, ends[k].y + block.y);
        sum += cell.drift_code <= window_.max_drift_code ? cell.likelihood : 0;
      }
      const int still_possible = kFullLikelihood * static_cast<int>(ends.size() - end);
      if (sum + still_possible < needed_sum) break;
    }
    return sum / full;
  }

  double Price(const Block& block) const {
    const double cell_m = map_.cell_size_m();
    if (block.level == 0) {
      const Eigen::Vector3d way(
          block.x * cell_m, block.y * cell_m, block.heading * heading_step_rad_);
      return price_ * way.dot(information_ * way);
    }
    const int side = 1 << block.level;
    const double x_m = cell_m * NearestToZero(block.x, side);
    const double y_m = cell_m * NearestToZero(block.y, side);
    return price_ * cheapest_per_m2_ * (x_m * x_m + y_m * y_m);
  }

  void Push(Block block) {
    if (IsExcluded(block)) return;
    const double price = Price(block);
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
    for (const int x : {block.x, block.x + (1 << level)}) {
      for (const int y : {block.y, block.y + (1 << level)}) {
        if (x <= reach_ && y <= reach_) Push({0.0, block.heading, x, y, level});
      }
    }
  }

  Pose2 PoseOf(const Block& block) const {
    const Pose2& center = window_.predicted.T_a_b;
    return {center.x_m + block.x * map_.cell_size_m(),
            center.y_m + block.y * map_.cell_size_m(),
            NormalizeAngle(center.theta_rad + block.heading * heading_step_rad_)};
  }

  const LikelihoodPyramid& map_;
  std::span<const Eigen::Vector2d> points_robot_m_;
  const SearchWindow& window_;
  const CorrelativeSearchOptions& options_;
  double heading_step_rad_ = 0.0;
  int headings_ = 0;  // Headings -headings_ .. headings_ are searched,
  int reach_ = 0;     // and offsets -reach_ .. reach_ in x and y.
  int level_ = 0;     // Where the search begins.
  double floor_;      // The best single pose met so far.
  Eigen::Matrix3d information_;
  double price_ = 0.0;  // Of a squared sigma away from the prediction, in units of the score.
  double cheapest_per_m2_ = 0.0;
  std::vector<CellOffset> cells_;  // Beam ends of all headings, one heading after the other.
  std::vector<Block> queue_;       // A heap, the highest bound first.
};

}  // namespace

std::optional<FoundPose> SearchPose(const LikelihoodPyramid& map,
                                    std::span<const Eigen::Vector2d> points_robot_m,
                                    const SearchWindow& window,
                                    const CorrelativeSearchOptions& options) {
  if (points_robot_m.empty()) return std::nullopt;
  return BranchAndBound(map, points_robot_m, window, options).Run();
}

}  // namespace qwsm
