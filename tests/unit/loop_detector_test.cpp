// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/loop_detector.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

/// A robot that closes a loop: it was here long ago, when its pose was exact.
class LoopClosure : public testing::Test {
 protected:
  void See(const World& world, unsigned seed = 3) {
    std::mt19937_64 random(seed);
    const SimulatedLaser laser{.beams = 361, .range_max_m = 20.0};
    map_ = ScanMap();
    const LaserScan then = Measure(laser, world, {}, random);
    map_.Insert(then, ToPoints(then), WithSigma({}, 0.01));
    points_ = ToPoints(Measure(laser, world, truth_, random));
  }

  std::optional<ClosedLoop> Find(const Pose2& estimated, double sigma_m) const {
    return LoopDetector().Detect(map_, points_, points_, WithSigma(estimated, sigma_m));
  }

  static UncertainPose2 WithSigma(const Pose2& pose, double sigma_m) {
    return UncertainPose2::WithSigmas(pose, sigma_m, 0.05 * sigma_m);
  }

  double Error_m(const ClosedLoop& found) const {
    return (found.map_robot.T_a_b.translation_m() - truth_.translation_m()).norm();
  }

  const Pose2 truth_{0.2, 0.1, 0.02};
  const Pose2 drifted_{0.5, 0.7, 0.025};
  ScanMap map_;
  std::vector<ScanPoint> points_;
};

/// Trunks around the robot.
World Grove() {
  return {.walls = {},
          .columns = {{.center_m = {5.0, 4.0}, .radius_m = 0.3},
                      {.center_m = {7.0, -3.0}, .radius_m = 0.2},
                      {.center_m = {1.5, 6.0}, .radius_m = 0.4},
                      {.center_m = {3.0, -5.5}, .radius_m = 0.3},
                      {.center_m = {9.0, 1.0}, .radius_m = 0.3}}};
}

/// Trunks that stand close together.
World ClumpAt(double x_m, double y_m) {
  return {.walls = {},
          .columns = {{.center_m = {x_m, y_m}, .radius_m = 0.4},
                      {.center_m = {x_m + 0.8, y_m + 0.9}, .radius_m = 0.3},
                      {.center_m = {x_m + 0.6, y_m - 1.0}, .radius_m = 0.35}}};
}

TEST_F(LoopClosure, IsFoundAmongTrees) {
  See(Grove());
  const auto found = Find(drifted_, 0.5);
  ASSERT_TRUE(found);
  EXPECT_LT(Error_m(*found), 0.03);
}

// It leaves open how the robot is turned: it fits all along an arc about the clump.
TEST_F(LoopClosure, IsMostlyFoundByOneClumpWithTheHelpOfTheEstimate) {
  constexpr unsigned kSeeds = 10;
  int found = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    See(ClumpAt(7.0, 0.0), seed);
    const auto there = Find(drifted_, 0.5);
    if (!there) continue;
    ++found;
    EXPECT_LT(Error_m(*there), 0.15) << "drifted by 0.67 m";
  }
  EXPECT_GE(found, 8);
}

TEST_F(LoopClosure, StaysWhereItIsBetweenTwoPlacesThatLookAlike) {
  See(ClumpAt(9.0, 2.0));
  const std::vector<ScanPoint> one_clump = points_;
  World twins = ClumpAt(9.0, 2.0);
  const World other = ClumpAt(9.0, -0.5);
  twins.columns.insert(twins.columns.end(), other.columns.begin(), other.columns.end());
  See(twins);
  points_ = one_clump;
  EXPECT_FALSE(Find({0.2, -1.15, 0.02}, 0.8));
}

TEST_F(LoopClosure, StaysWhereItIsBetweenWallsThatLookTheSameEverywhere) {
  See({.walls = {{.from_m = {-40.0, 1.2}, .to_m = {60.0, 1.2}},
                 {.from_m = {-40.0, -1.2}, .to_m = {60.0, -1.2}}},
       .columns = {}});
  EXPECT_FALSE(Find({2.0, 0.1, 0.02}, 0.5));
}

TEST_F(LoopClosure, StaysWhereTheMapDriftedAsMuch) {
  See(Grove());
  EXPECT_FALSE(Find(drifted_, 0.012));
}

TEST_F(LoopClosure, HasTheErrorOfTheSurfacesMappedBeforeToo) {
  See(Grove());
  const auto found = Find(drifted_, 0.5);
  ASSERT_TRUE(found);
  EXPECT_GE(found->map_robot.covariance(0, 0), 0.01 * 0.01);
  EXPECT_LT(found->match.covariance(0, 0), 0.01 * 0.01) << "of the pose among them";
}

}  // namespace
}  // namespace qwsm::test
