// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/matching/mode_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_set>
#include <utility>

namespace qwsm {
namespace {

constexpr double kDistrict_m = 200.0;
constexpr double kFarthestModePoint_m = 25.0;  // The farther points reach, the finer are headings.
// Poses so near to each other are one mode: the exact search around one finds the other.
constexpr double kSameMode_m = 0.3;
constexpr double kSameMode_rad = 0.1;
constexpr double kHighScore = 0.75;  // Of most scans in their place.
constexpr double kLower = 0.8;
constexpr int kLevelsOfMode = 2;             // Blocks of higher levels are wider than that.
constexpr std::size_t kMostModes = 64;       // More are no knowledge.
constexpr std::size_t kMostBlocks = 120000;  // Where everything is alike, the search is given up.

// Poses with the robot in a square of positions, as wide as a level of CoarseLikelihood says, and
// the heading in an interval: turning to either end of it moves no point by more than
// CoarseLikelihood::kFarMove of the width.
struct PoseBlock {
  double bound = 0.0;
  int level = 0;
  std::uint32_t district = 0;
  int heading = 0;  // Of so many of the level.
  int x = 0;        // First position, in cells of the pyramid.
  int y = 0;
};

// Blocks by their bounds, those of nearly the same in no order: a heap would move each of them
// through memory again and again.
class BlockQueue {
 public:
  bool empty() const { return highest_ < 0; }
  void Clear() {
    for (; highest_ >= 0; --highest_) blocks_[static_cast<std::size_t>(highest_)].clear();
  }
  void Push(const PoseBlock& block) {
    const int step = StepOf(block.bound);
    blocks_[static_cast<std::size_t>(step)].push_back(block);
    highest_ = std::max(highest_, step);
  }
  // One of those with the highest bounds. @pre there is one
  PoseBlock Pop() {
    std::vector<PoseBlock>& best = blocks_[static_cast<std::size_t>(highest_)];
    const PoseBlock block = best.back();
    best.pop_back();
    while (highest_ >= 0 && blocks_[static_cast<std::size_t>(highest_)].empty()) --highest_;
    return block;
  }
  // No bound is higher. @pre it is not empty
  double Highest() const { return (highest_ + 1.0) / kSteps; }

 private:
  static constexpr int kSteps = 4096;  // From 0 to 1.
  static int StepOf(double bound) {
    return std::clamp(static_cast<int>(bound * kSteps), 0, kSteps);
  }

  std::vector<std::vector<PoseBlock>> blocks_ = std::vector<std::vector<PoseBlock>>(kSteps + 1);
  int highest_ = -1;  // Step of the highest bound.
};

int WidthOf(int level) { return CoarseLikelihood::WidthOf(level); }

// Where the beams end in the frame of the robot turned to the headings of one level; found for each
// when it is first asked for.
class TurnedPoints {
 public:
  // @param points_m so many near ones first, which a turn moves half as far as it may.
  TurnedPoints(std::span<const Eigen::Vector2d> points_m,
               std::size_t near,
               int headings,
               double cell_m)
      : points_m_(points_m),
        near_(near),
        cell_m_(cell_m),
        cells_(static_cast<std::size_t>(headings)) {}

  int headings() const { return static_cast<int>(cells_.size()); }
  double HalfWidth_rad() const { return std::numbers::pi / headings(); }
  double Middle_rad(int heading) const { return (2 * heading + 1) * HalfWidth_rad(); }
  CoarseLikelihood::Cells At(int heading) {
    std::vector<GridCell>& cells = cells_[static_cast<std::size_t>(heading)];
    if (cells.empty()) cells = CellsAt(Middle_rad(heading));
    const std::span all(cells);
    return {.near = all.first(near_), .far = all.subspan(near_)};
  }

 private:
  std::vector<GridCell> CellsAt(double heading_rad) const {
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(heading_rad).toRotationMatrix();
    std::vector<GridCell> cells;
    cells.reserve(points_m_.size());
    for (const Eigen::Vector2d& p_m : points_m_) {
      const Eigen::Vector2d cell = (R * p_m / cell_m_).array().floor();
      cells.push_back({static_cast<int>(cell.x()), static_cast<int>(cell.y())});
    }
    return cells;
  }

  std::span<const Eigen::Vector2d> points_m_;
  std::size_t near_;
  double cell_m_;
  std::vector<std::vector<GridCell>> cells_;  // By heading; none where nobody asked yet.
};

std::vector<Eigen::Vector2d> NearOnes(std::span<const Eigen::Vector2d> points_m) {
  std::vector<Eigen::Vector2d> near_m;
  for (const Eigen::Vector2d& p_m : points_m) {
    if (p_m.norm() < kFarthestModePoint_m) near_m.push_back(p_m);
  }
  return near_m;
}

double FarthestOf(std::span<const Eigen::Vector2d> points_m) {
  double lever_m = 1.0;
  for (const Eigen::Vector2d& p_m : points_m) lever_m = std::max(lever_m, p_m.norm());
  return lever_m;
}

// Places within the same square of a map's plan.
std::vector<std::vector<Eigen::Vector2d>> ByDistrict(std::span<const Eigen::Vector2d> places_m) {
  std::map<std::pair<double, double>, std::vector<Eigen::Vector2d>> districts;
  for (const Eigen::Vector2d& place_m : places_m) {
    const Eigen::Vector2d district = (place_m / kDistrict_m).array().floor();
    districts[{district.x(), district.y()}].push_back(place_m);
  }
  std::vector<std::vector<Eigen::Vector2d>> list;
  for (auto& [key, of_district_m] : districts) list.push_back(std::move(of_district_m));
  return list;
}

Eigen::AlignedBox2d AreaAround(std::span<const Eigen::Vector2d> places_m, double reach_m) {
  Eigen::AlignedBox2d area;
  for (const Eigen::Vector2d& place_m : places_m) area.extend(place_m);
  const Eigen::Vector2d around_m = Eigen::Vector2d::Constant(reach_m);
  return {area.min() - around_m, area.max() + around_m};
}

constexpr int kTop = CoarseLikelihood::kLevels - 1;

double WidestBlock_m(const LikelihoodPyramid& map) { return WidthOf(kTop) * map.cell_size_m(); }

class ModeSearch {
 public:
  ModeSearch(const LikelihoodPyramid& map,
             const ModeSearchArea& area,
             std::vector<Eigen::Vector2d> points_m,
             const ModeSearchLimits& limits)
      : map_(map), area_(area), points_m_(std::move(points_m)), limits_(limits) {
    const double lever_m = FarthestOf(points_m_);
    const double half_width_rad = CoarseLikelihood::kFarMove * WidestBlock_m(map) / lever_m;
    int headings = static_cast<int>(std::ceil(std::numbers::pi / half_width_rad));
    const auto far = std::ranges::partition(
        points_m_, [&](const Eigen::Vector2d& p_m) { return p_m.norm() <= 0.5 * lever_m; });
    const std::size_t near = points_m_.size() - far.size();
    for (int level = kTop; level >= 0; --level, headings *= 2) {
      turned_.emplace_back(points_m_, near, headings, map.cell_size_m());
    }
    std::ranges::reverse(turned_);
  }

  // The higher the threshold, the fewer blocks are of interest: a low one serves only where nothing
  // is known to score more. What is found is the same.
  FoundModes Run() {
    const double least = std::max(limits_.min_score, limits_.known_score - limits_.margin);
    double score = limits_.known_score > 0.0 ? least : std::max(least, kHighScore);
    FoundModes found = RunAbove(score);
    while (!is_given_up_ && score > least) {
      const double enough =
          found.modes.empty() ? kLower * score : found.modes.front().score - limits_.margin;
      if (enough >= score) break;
      score = std::max(least, enough);
      found = RunAbove(score);
    }
    return found;
  }

 private:
  FoundModes RunAbove(double score) {
    threshold_ = score;
    queue_.Clear();
    tried_.clear();
    found_.clear();
    PushPlaces();
    for (; !queue_.empty(); ++visited_) {
      const double highest = queue_.Highest();
      if (highest <= threshold_) break;
      const PoseBlock block = queue_.Pop();
      if (block.bound <= threshold_ || IsTried(block)) continue;
      is_given_up_ = visited_ >= kMostBlocks || found_.size() == kMostModes;
      if (is_given_up_) return Best(highest);
      block.level == 0 ? Try(block) : PushParts(block);
    }
    return Best(threshold_);
  }

  // The coarsest blocks around the places, each once.
  void PushPlaces() {
    std::unordered_set<std::uint64_t> seen;
    for (std::uint32_t district = 0; district < area_.districts().size(); ++district) {
      for (const Eigen::Vector2d& place_m : area_.districts()[district].places_m) {
        PushAround(place_m, district, seen);
      }
    }
  }

  void PushAround(const Eigen::Vector2d& place_m,
                  std::uint32_t district,
                  std::unordered_set<std::uint64_t>& seen) {
    const int width = WidthOf(kTop);
    const auto index = [&](double coordinate_m) {
      return static_cast<int>(std::floor(coordinate_m / (width * map_.cell_size_m())));
    };
    const double reach_m = area_.reach_m();
    for (int x = index(place_m.x() - reach_m); x <= index(place_m.x() + reach_m); ++x) {
      for (int y = index(place_m.y() - reach_m); y <= index(place_m.y() + reach_m); ++y) {
        const std::uint64_t key =
            std::uint64_t{static_cast<std::uint32_t>(x)} << 32 | static_cast<std::uint32_t>(y);
        if (!seen.insert(key).second) continue;
        for (int heading = 0; heading < turned_.back().headings(); ++heading) {
          const PoseBlock block{.level = kTop,
                                .district = district,
                                .heading = heading,
                                .x = x * width,
                                .y = y * width};
          Push(block, BoundsOfFour(block).front());
        }
      }
    }
  }

  void Push(PoseBlock block, double bound) {
    if (bound <= threshold_) return;
    block.bound = bound;
    queue_.Push(block);
  }

  CoarseLikelihood::FourBounds BoundsOfFour(const PoseBlock& first) {
    TurnedPoints& turned = turned_[static_cast<std::size_t>(first.level)];
    return area_.districts()[first.district].likelihood->BoundsOfFour(
        first.level, turned.At(first.heading), {first.x, first.y}, threshold_);
  }

  // The two halves of its headings in the four quarters of its square.
  void PushParts(const PoseBlock& block) {
    const int level = block.level - 1;
    const int width = WidthOf(level);
    for (int half = 0; half < 2; ++half) {
      PoseBlock part = block;
      part.level = level;
      part.heading = 2 * block.heading + half;
      const CoarseLikelihood::FourBounds bounds = BoundsOfFour(part);
      for (int quarter = 0; quarter < 4; ++quarter) {
        part.x = block.x + (quarter & 1) * width;
        part.y = block.y + (quarter >> 1) * width;
        Push(part, bounds[static_cast<std::size_t>(quarter)]);
      }
    }
  }

  // Finds the exact mode near one of the finest blocks.
  void Try(const PoseBlock& block) {
    const Pose2 middle = MiddleOf(block);
    tried_.push_back(middle);
    SearchWindow around = FlatWindow(middle, kSameMode_m, kSameMode_rad);
    around.min_score = threshold_;
    const std::optional<FoundPose> found = SearchPose(map_, points_m_, around, {});
    if (!found) return;
    found_.push_back(*found);
    threshold_ = std::max(threshold_, found->score - limits_.margin);
  }

  bool IsTried(const PoseBlock& block) const {
    if (block.level > kLevelsOfMode) return false;
    const Pose2 middle = MiddleOf(block);
    return std::ranges::any_of(tried_, [&](const Pose2& pose) { return IsSameMode(pose, middle); });
  }

  Pose2 MiddleOf(const PoseBlock& block) const {
    const double half = 0.5 * WidthOf(block.level);
    return {
        (block.x + half) * map_.cell_size_m(),
        (block.y + half) * map_.cell_size_m(),
        NormalizeAngle(turned_[static_cast<std::size_t>(block.level)].Middle_rad(block.heading))};
  }

  static bool IsSameMode(const Pose2& a, const Pose2& b) {
    return (a.translation_m() - b.translation_m()).squaredNorm() < kSameMode_m * kSameMode_m &&
           std::abs(NormalizeAngle(a.theta_rad - b.theta_rad)) < kSameMode_rad;
  }

  // @param floor_score what was not visited scores no better.
  FoundModes Best(double floor_score) {
    std::ranges::stable_sort(found_, std::ranges::greater{}, &FoundPose::score);
    FoundModes best{.modes = {}, .floor_score = floor_score};
    for (const FoundPose& one : found_) {
      const bool is_new = std::ranges::none_of(best.modes, [&](const FoundPose& better) {
        return IsSameMode(better.T_map_robot, one.T_map_robot);
      });
      if (is_new && one.score >= threshold_) best.modes.push_back(one);
    }
    return best;
  }

  const LikelihoodPyramid& map_;
  const ModeSearchArea& area_;
  std::vector<Eigen::Vector2d> points_m_;
  const ModeSearchLimits& limits_;
  std::vector<TurnedPoints> turned_;  // By level.
  double threshold_ = 0.0;            // What scores less is of no interest.
  bool is_given_up_ = false;
  std::size_t visited_ = 0;  // Blocks, so far.
  BlockQueue queue_;
  std::vector<Pose2> tried_;
  std::vector<FoundPose> found_;
};

}  // namespace

ModeSearchArea::ModeSearchArea(const LikelihoodPyramid& map,
                               std::span<const Eigen::Vector2d> places_m,
                               double reach_m)
    : reach_m_(reach_m) {
  const double around_m = reach_m + kFarthestModePoint_m + 4.0 * WidestBlock_m(map);
  for (std::vector<Eigen::Vector2d>& of_district_m : ByDistrict(places_m)) {
    const Eigen::AlignedBox2d box = AreaAround(of_district_m, around_m);
    districts_.push_back(
        {std::move(of_district_m), std::make_shared<const CoarseLikelihood>(map, box)});
  }
}

ModeSearchArea ModeSearchArea::Without(const Eigen::Vector2d& center_m, double radius_m) const {
  ModeSearchArea rest = *this;
  for (District& district : rest.districts_) {
    std::erase_if(district.places_m, [&](const Eigen::Vector2d& place_m) {
      return (place_m - center_m).norm() < radius_m;
    });
  }
  return rest;
}

FoundModes SearchModes(const LikelihoodPyramid& map,
                       const ModeSearchArea& area,
                       std::span<const Eigen::Vector2d> points_robot_m,
                       const ModeSearchLimits& limits) {
  std::vector<Eigen::Vector2d> near_m = NearOnes(points_robot_m);
  if (near_m.empty() || area.districts().empty()) return {};
  return ModeSearch(map, area, std::move(near_m), limits).Run();
}

SearchWindow FlatWindow(const Pose2& T_map_robot, double translation_m, double rotation_rad) {
  constexpr double kFlat = 1e6;  // m, rad.
  return {.predicted = UncertainPose2::WithSigmas(T_map_robot, kFlat, kFlat),
          .translation_m = translation_m,
          .rotation_rad = rotation_rad};
}

}  // namespace qwsm
