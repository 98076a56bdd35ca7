// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The search for modes finds what an exhaustive search of all positions and headings would find.
#include "qwsm/matching/mode_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace qwsm {
namespace {

using Points = std::vector<Eigen::Vector2d>;
using Random = std::mt19937_64;

constexpr double kExtent_m = 6.0;
const Points kPlaces = {{-2.0, 0.0}, {2.0, 0.0}};

Points AnyPlaces(Random& random, int count) {
  std::uniform_real_distribution<double> coordinate_m(-kExtent_m, kExtent_m);
  Points points_m;
  for (int i = 0; i < count; ++i) points_m.emplace_back(coordinate_m(random), coordinate_m(random));
  return points_m;
}

LikelihoodPyramid PyramidOf(const Points& points_m) {
  LikelihoodPyramid map;
  for (const Eigen::Vector2d& p_m : points_m) map.Insert(p_m, 0.0);
  return map;
}

Points SeenFrom(const Pose2& T_map_robot, const Points& points_m) {
  Points seen_m;
  for (const Eigen::Vector2d& p_m : points_m) seen_m.push_back(T_map_robot.Inverse() * p_m);
  return seen_m;
}

bool IsNear(const Pose2& a, const Pose2& b) {
  return (a.translation_m() - b.translation_m()).norm() < 0.1 &&
         std::abs(NormalizeAngle(a.theta_rad - b.theta_rad)) < 0.03;
}

/// The best score of all headings and of a square around the origin.
double BestScore(const LikelihoodPyramid& map, const Points& points_m, double reach_m) {
  SearchWindow window{.predicted = {}, .translation_m = reach_m, .rotation_rad = std::numbers::pi};
  window.predicted.covariance = 1e12 * Eigen::Matrix3d::Identity();
  return SearchPose(map, points_m, window, {})->score;
}

FoundModes FindModes(const LikelihoodPyramid& map,
                     const Points& places_m,
                     const Points& scan_m,
                     const ModeSearchLimits& limits) {
  constexpr double kReach_m = 1.5;
  return SearchModes(map, ModeSearchArea(map, places_m, kReach_m), scan_m, limits);
}

TEST(ModeSearch, FindsWhereTheScanWasTakenAtAnyHeading) {
  Random random(1);
  std::uniform_real_distribution<double> angle_rad(-std::numbers::pi, std::numbers::pi);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const Points walls_m = AnyPlaces(random, 80);
    const Pose2 T_map_robot(1.3, -0.7, angle_rad(random));
    const FoundModes found =
        FindModes(PyramidOf(walls_m), kPlaces, SeenFrom(T_map_robot, walls_m), {.margin = 0.1});
    ASSERT_FALSE(found.modes.empty());
    EXPECT_TRUE(IsNear(found.modes.front().T_map_robot, T_map_robot));
    EXPECT_LE(found.floor_score, found.modes.front().score - 0.1 + 1e-9);
  }
}

TEST(ModeSearch, FindsNoWorsePoseThanAnExhaustiveSearch) {
  Random random(2);
  const Points origin = {{0.0, 0.0}};
  for (int round = 0; round < 8; ++round) {
    SCOPED_TRACE(round);
    const LikelihoodPyramid map = PyramidOf(AnyPlaces(random, 150));
    const Points scan_m = AnyPlaces(random, 30);  // Which was taken nowhere in the map.
    const FoundModes found = FindModes(map, origin, scan_m, {});
    ASSERT_FALSE(found.modes.empty());
    EXPECT_GT(found.modes.front().score, BestScore(map, scan_m, 1.5) - 0.02);
  }
}

TEST(ModeSearch, FindsAllPlacesThatAreAlike) {
  Random random(3);
  const Points room_m = AnyPlaces(random, 40);
  const Pose2 T_map_other(30.0, 5.0, 2.0);
  Points both_m = room_m;
  for (const Eigen::Vector2d& p_m : room_m) both_m.push_back(T_map_other * p_m);
  const Pose2 T_map_robot(0.5, 0.5, 0.3);
  const Points places = {
      T_map_robot.translation_m(), (T_map_other * T_map_robot).translation_m(), {15.0, 2.5}};
  const FoundModes found =
      FindModes(PyramidOf(both_m), places, SeenFrom(T_map_robot, room_m), {.margin = 0.1});
  ASSERT_EQ(found.modes.size(), 2U);
  const bool is_first = IsNear(found.modes[0].T_map_robot, T_map_robot);
  EXPECT_TRUE(IsNear(found.modes[is_first ? 0 : 1].T_map_robot, T_map_robot));
  EXPECT_TRUE(IsNear(found.modes[is_first ? 1 : 0].T_map_robot, T_map_other * T_map_robot));
}

TEST(ModeSearch, FindsTheSameWhereTheBestScoreIsKnown) {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    SCOPED_TRACE(round);
    const Points walls_m = AnyPlaces(random, 80);
    const LikelihoodPyramid map = PyramidOf(walls_m);
    const Points scan_m = SeenFrom({1.3, -0.7, 2.0}, Points(walls_m.begin() + 40, walls_m.end()));
    const FoundModes found = FindModes(map, kPlaces, scan_m, {.margin = 0.3});
    ASSERT_FALSE(found.modes.empty());
    const double best = found.modes.front().score;
    const FoundModes again = FindModes(map, kPlaces, scan_m, {.margin = 0.3, .known_score = best});
    ASSERT_EQ(again.modes.size(), found.modes.size());
    for (std::size_t i = 0; i < found.modes.size(); ++i) {
      EXPECT_TRUE(IsNear(again.modes[i].T_map_robot, found.modes[i].T_map_robot));
    }
    EXPECT_NEAR(again.floor_score, best - 0.3, 1e-9);
    EXPECT_TRUE(FindModes(map, kPlaces, scan_m, {.known_score = best + 0.01}).modes.empty());
  }
}

// A window around all of them would not fit into memory.
TEST(ModeSearch, SearchesMapsThatAreFarApart) {
  Random random(4);
  const Points room_m = AnyPlaces(random, 40);
  const Pose2 T_map_other(2e6, -3e6, 1.0);
  Points both_m = AnyPlaces(random, 40);
  for (const Eigen::Vector2d& p_m : room_m) both_m.push_back(T_map_other * p_m);
  const Pose2 T_map_robot = T_map_other * Pose2(0.5, 0.5, 0.3);
  const Points places = {{0.0, 0.0}, T_map_robot.translation_m()};
  const FoundModes found =
      FindModes(PyramidOf(both_m), places, SeenFrom({0.5, 0.5, 0.3}, room_m), {.margin = 0.1});
  ASSERT_FALSE(found.modes.empty());
  EXPECT_TRUE(IsNear(found.modes[0].T_map_robot, T_map_robot));
}

TEST(ModeSearch, FindsNothingWhereThereIsNothingToFind) {
  const Points one_m = {{1.0, 1.0}};
  EXPECT_TRUE(FindModes(PyramidOf({}), kPlaces, one_m, {.min_score = 0.3}).modes.empty());
  EXPECT_TRUE(FindModes(PyramidOf(one_m), kPlaces, {}, {}).modes.empty());
  EXPECT_TRUE(FindModes(PyramidOf(one_m), {}, one_m, {}).modes.empty());
}

}  // namespace
}  // namespace qwsm
