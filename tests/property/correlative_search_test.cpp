// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Branch and bound finds what trying every pose of the window would find.
#include "qwsm/matching/correlative_search.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "qwsm/search/likelihood_window.hpp"

namespace qwsm {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Random = std::mt19937_64;

double Uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

Points AnyPoints(Random& random, int count, double extent_m) {
  Points points_m;
  for (int i = 0; i < count; ++i) {
    points_m.emplace_back(Uniform(random, -extent_m, extent_m),
                          Uniform(random, -extent_m, extent_m));
  }
  return points_m;
}

/// Mean likelihood of the beam ends less the cost of the prior, as the search defines it.
double ScoreAt(const LikelihoodPyramid& map,
               const Points& points_robot_m,
               const Pose2& T_map_turned,
               int x,
               int y,
               std::uint8_t max_drift_code) {
  double sum = 0.0;
  for (const Eigen::Vector2d& p_robot : points_robot_m) {
    const Eigen::Vector2d p_map = T_map_turned * p_robot;
    const GridCell cell{map.CellIndex(p_map.x()) + x, map.CellIndex(p_map.y()) + y};
    const int drift_code = map.DriftCodeAt(0, cell.x, cell.y);
    if (max_drift_code == LikelihoodPyramid::kUnmapped || drift_code <= max_drift_code) {
      sum += map.LikelihoodAt(0, cell.x, cell.y);
    }
  }
  return sum / (255.0 * static_cast<double>(points_robot_m.size()));
}

/// The best score of all poses of the window, tried one by one; `min_score` where none is better.
double BestOfAll(const LikelihoodPyramid& map,
                 const Points& points_robot_m,
                 const SearchWindow& window,
                 const CorrelativeSearchOptions& options) {
  double lever_m = 1.0;
  for (const Eigen::Vector2d& p : points_robot_m) lever_m = std::max(lever_m, p.norm());
  const double cell_m = map.cell_size_m();
  const double step_rad = cell_m / std::min(lever_m, options.lever_m);
  const int headings = static_cast<int>(std::ceil(window.rotation_rad / step_rad));
  const int reach = static_cast<int>(std::ceil(window.translation_m / cell_m));
  const Eigen::Matrix3d information = window.predicted.covariance.inverse();
  const Pose2& center = window.predicted.T_a_b;
  const double cost =
      options.prior_cost_points / std::min(static_cast<double>(points_robot_m.size()),
                                           static_cast<double>(options.independent_points));
  double best = window.min_score;
  for (int heading = -headings; heading <= headings; ++heading) {
    const Pose2 turned{center.x_m, center.y_m, center.theta_rad + heading * step_rad};
    for (int x = -reach; x <= reach; ++x) {
      for (int y = -reach; y <= reach; ++y) {
        const Eigen::Vector2d place_m = center.translation_m() + cell_m * Eigen::Vector2d(x, y);
        const bool is_excluded =
            window.excluded &&
            (place_m - window.excluded->center_map_m).norm() <= window.excluded->radius_m;
        if (is_excluded) continue;
        const Eigen::Vector3d way(x * cell_m, y * cell_m, heading * step_rad);
        const double score = ScoreAt(map, points_robot_m, turned, x, y, window.max_drift_code) -
                             cost * way.dot(information * way);
        best = std::max(best, score);
      }
    }
  }
  return best;
}

/// Correlated errors of any size.
Eigen::Matrix3d AnyCovariance(Random& random) {
  Eigen::Matrix3d root;
  for (double& entry : root.reshaped()) entry = Uniform(random, -0.3, 0.3);
  return root * root.transpose() + 1e-3 * Eigen::Matrix3d::Identity();
}

/// Points that are stored, and a scan that sees some of them from where the map begins.
struct Surroundings {
  LikelihoodPyramid map;
  Points scan_m;
};

Surroundings AnySurroundings(Random& random, double extent_m) {
  Surroundings any;
  const Points stored_m = AnyPoints(random, 60, extent_m);
  for (const Eigen::Vector2d& p_m : stored_m) any.map.Insert(p_m, 1e-6);
  any.scan_m.assign(stored_m.begin(), stored_m.begin() + 25);
  return any;
}

/// @return what is found, which is the best of all.
std::optional<FoundPose> SearchForBestOfAll(const LikelihoodPyramid& map,
                                            const Points& scan_m,
                                            const SearchWindow& window,
                                            const CorrelativeSearchOptions& options) {
  const double best = BestOfAll(map, scan_m, window, options);
  const auto found = SearchPose(map, scan_m, window, options);
  EXPECT_EQ(found.has_value(), best > window.min_score);
  if (found) {
    EXPECT_NEAR(found->score, best, 1e-12);
  }
  return found;
}

TEST(CorrelativeSearch, FindsTheBestOfAllPosesOfTheWindow) {
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    LikelihoodPyramid map;
    const Points stored_m = AnyPoints(random, 60, 3.0);
    for (const Eigen::Vector2d& p_m : stored_m) map.Insert(p_m, Uniform(random, 1e-6, 1e-2));
    const Pose2 T_map_robot{
        Uniform(random, -1.0, 1.0), Uniform(random, -1.0, 1.0), Uniform(random, -3.0, 3.0)};
    Points scan_m;
    for (std::size_t i = 0; i < 25; ++i) scan_m.push_back(T_map_robot.Inverse() * stored_m[i]);

    SearchWindow window{.predicted = {T_map_robot * Pose2{Uniform(random, -0.3, 0.3),
                                                          Uniform(random, -0.3, 0.3),
                                                          Uniform(random, -0.05, 0.05)},
                                      AnyCovariance(random)},
                        .translation_m = Uniform(random, 0.0, 0.9),
                        .rotation_rad = Uniform(random, 0.0, 0.1)};
    if (seed % 3 == 1) window.max_drift_code = LikelihoodPyramid::DriftCode(5e-3);
    if (seed % 4 == 1) {
      window.excluded = {.center_map_m = T_map_robot.translation_m(), .radius_m = 0.25};
    }
    const CorrelativeSearchOptions options{.prior_cost_points = seed % 2 == 0 ? 0.4 : 2.0};
    SearchForBestOfAll(map, scan_m, window, options);
  }
}

TEST(CorrelativeSearch, SeveralSearchesOfOneWindowFindWhatEachAloneWould) {
  for (int seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    LikelihoodPyramid map;
    const Points scan_m = AnyPoints(random, 60, 3.0);
    for (const Eigen::Vector2d& p_m : scan_m) map.Insert(p_m, 1e-6);
    SearchWindow window{
        .predicted = {{}, AnyCovariance(random)}, .translation_m = 1.5, .rotation_rad = 0.1};
    PoseSearch search(map, scan_m, window, {});
    for (const double radius_m : {0.0, 0.2, 0.4, 0.8}) {
      window.excluded = {.center_map_m = {0.0, 0.0}, .radius_m = radius_m};
      const auto alone = SearchPose(map, scan_m, window, {});
      const auto together = search.Best(window.min_score, window.excluded);
      ASSERT_EQ(alone.has_value(), together.has_value());
      if (alone) {
        EXPECT_EQ(alone->score, together->score);
      }
    }
  }
}

TEST(CorrelativeSearch, FindsTheBestPoseOutsideOfWhatWasSearchedBefore) {
  int found_further = 0;
  for (int seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    const auto [map, scan_m] = AnySurroundings(random, 3.0);
    const WindowReach narrow{.translation_m = Uniform(random, 0.0, 0.4),
                             .rotation_rad = Uniform(random, 0.0, 0.1)};
    SearchWindow window{.predicted = {{Uniform(random, -0.6, 0.6),
                                       Uniform(random, -0.6, 0.6),
                                       Uniform(random, -0.15, 0.15)},
                                      AnyCovariance(random)},
                        .translation_m = narrow.translation_m,
                        .rotation_rad = narrow.rotation_rad};
    const auto near = SearchPose(map, scan_m, window, {});
    window.min_score = near ? near->score : 0.0;
    window.translation_m = std::max(window.translation_m, Uniform(random, 0.0, 1.0));
    window.rotation_rad = std::max(window.rotation_rad, Uniform(random, 0.0, 0.2));
    window.searched = narrow;
    if (SearchForBestOfAll(map, scan_m, window, {})) ++found_further;
  }
  EXPECT_GT(found_further, 5);
  EXPECT_LT(found_further, 35);
}

TEST(CorrelativeSearch, FindsTheBestOfAllPosesWhereBeamsSweepFar) {
  for (int seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<unsigned>(seed));
    const auto [map, scan_m] = AnySurroundings(random, 40.0);
    const SearchWindow window{
        .predicted = {{0.2, -0.1, 0.05}, AnyCovariance(random)},
        .translation_m = seed % 2 == 0 ? 0.3 : 1.4,  // The latter takes several areas of blocks.
        .rotation_rad = 0.15};
    const CorrelativeSearchOptions options{.lever_m = seed % 3 == 0 ? 2.0 : 15.0};
    SearchForBestOfAll(map, scan_m, window, options);
  }
}

TEST(CorrelativeSearch, InterpolatesBetweenTheCells) {
  LikelihoodPyramid map;
  Points room_m;
  for (double s_m = -2.0; s_m <= 2.0; s_m += 0.05) {
    room_m.insert(room_m.end(), {{s_m, -2.0}, {s_m, 2.0}, {-2.0, s_m}, {2.0, s_m}});
  }
  for (const Eigen::Vector2d& p_m : room_m) map.Insert(p_m, 1e-6);
  const double cell_m = map.cell_size_m();
  double sum_of_errors_m2 = 0.0;
  constexpr int kTrials = 100;
  for (int trial = 0; trial < kTrials; ++trial) {
    Random random(static_cast<unsigned>(trial));
    const Pose2 T_map_robot{Uniform(random, -0.3, 0.3), Uniform(random, -0.3, 0.3), 0.0};
    Points scan_m;
    for (const Eigen::Vector2d& p_m : room_m) scan_m.push_back(T_map_robot.Inverse() * p_m);
    const SearchWindow window{
        .predicted = {{}, Eigen::Matrix3d::Identity()}, .translation_m = 0.4, .rotation_rad = 0.01};
    const auto found = SearchPose(map, scan_m, window, {});
    ASSERT_TRUE(found);
    sum_of_errors_m2 +=
        (found->T_map_robot.translation_m() - T_map_robot.translation_m()).squaredNorm();
  }
  // What is uniform over a cell has a variance of a twelfth along each axis.
  EXPECT_LT(sum_of_errors_m2 / kTrials, 0.25 * cell_m * cell_m / 6.0);
}

TEST(CorrelativeSearch, FindsNothingThatScoresTooLittle) {
  LikelihoodPyramid map;
  map.Insert({0.0, 0.0}, 1e-6);
  const SearchWindow window{.predicted = {{}, Eigen::Matrix3d::Identity()},
                            .translation_m = 0.5,
                            .rotation_rad = 0.1,
                            .min_score = 0.6};
  EXPECT_TRUE(SearchPose(map, Points{{0.0, 0.0}}, window, {}));
  EXPECT_FALSE(SearchPose(map, Points{{0.0, 0.0}, {9.0, 9.0}}, window, {}));
  EXPECT_FALSE(SearchPose(map, Points{}, window, {}));
  EXPECT_FALSE(SearchPose(LikelihoodPyramid(), Points{{0.0, 0.0}}, window, {}));
}

}  // namespace
}  // namespace qwsm
