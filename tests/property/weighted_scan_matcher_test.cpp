// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Laws that a match must keep, whatever its figures.
#include "qwsm/matching/weighted_scan_matcher.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "qwsm/mapping/scan_map.hpp"
#include "qwsm/metrics/nees.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

using Random = std::mt19937_64;

Pose2 AnyPose(Random& random, double translation_m, double rotation_rad) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  const double x_m = translation_m * share(random);
  const double y_m = translation_m * share(random);
  return {x_m, y_m, rotation_rad * share(random)};
}

/// A map of one scan, taken where the robot stands.
ScanMap MapOf(const LaserScan& scan, const Pose2& T_map_robot) {
  ScanMap map;
  map.Insert(scan, ToPoints(scan), {.T_a_b = T_map_robot});
  return map;
}

/// Next to nothing is known but where to begin.
MatchPrior WeakPriorAt(const Pose2& start) {
  return {.predicted = {start, Eigen::Vector3d(1.0, 1.0, 1.0).asDiagonal()},
          .start = start,
          .start_error = {.translation_m = 0.1}};
}

MatchResult Match(const ScanMap& map, const LaserScan& scan, const MatchPrior& prior) {
  return WeightedScanMatcher().Match(map.surfaces(), ToPoints(scan), prior);
}

/// How far two poses are apart, a radian counting as many metres.
double Apart(const Pose2& a, const Pose2& b) {
  const Pose2 difference = a.Inverse() * b;
  return difference.translation_m().norm() + std::abs(difference.theta_rad);
}

/// A furnished room, seen from two places near each other.
struct TwoScans {
  explicit TwoScans(unsigned seed) : random(seed) {
    const Scene scene = FurnishedRoom();
    const Eigen::Vector2d from_m = scene.route_m[0];
    const Eigen::Vector2d way_m = scene.route_m[1] - from_m;
    T_world_ref = {from_m.x(), from_m.y(), std::atan2(way_m.y(), way_m.x())};
    T_ref_cur = AnyPose(random, 0.15, 0.1);
    ref = Measure({}, scene.world, T_world_ref, random);
    cur = Measure({}, scene.world, T_world_ref * T_ref_cur, random);
  }

  Random random;
  Pose2 T_world_ref;
  Pose2 T_ref_cur;
  LaserScan ref;
  LaserScan cur;
};

TEST(WeightedScanMatcher, FindsWhereTheScanWasTaken) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    TwoScans scans(seed);
    const Pose2 start = scans.T_ref_cur * AnyPose(scans.random, 0.05, 0.03);
    const MatchResult result = Match(MapOf(scans.ref, {}), scans.cur, WeakPriorAt(start));
    EXPECT_EQ(result.status, MatchStatus::kConverged);
    EXPECT_LT(Apart(result.T_ref_cur, scans.T_ref_cur), 0.03);
    EXPECT_GT(result.overlap, 0.8);
    // Symmetric and positive definite.
    EXPECT_NEAR((result.covariance - result.covariance.transpose()).norm(), 0.0, 1e-12);
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(result.covariance);
    EXPECT_GT(axes.eigenvalues().minCoeff(), 0.0);
  }
}

TEST(WeightedScanMatcher, SwappedScansGiveTheInversePose) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const TwoScans scans(seed);
    const MatchResult there = Match(MapOf(scans.ref, {}), scans.cur, WeakPriorAt(scans.T_ref_cur));
    const MatchResult back =
        Match(MapOf(scans.cur, {}), scans.ref, WeakPriorAt(scans.T_ref_cur.Inverse()));
    EXPECT_LT(Apart(there.T_ref_cur, back.T_ref_cur.Inverse()), 0.02);
  }
}

TEST(WeightedScanMatcher, MovingBothMovesTheResult) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    TwoScans scans(seed);
    const Pose2 T_map_ref = AnyPose(scans.random, seed < 10 ? 10.0 : 5000.0, 3.0);
    const MatchPrior prior = WeakPriorAt(scans.T_ref_cur * AnyPose(scans.random, 0.03, 0.02));
    MatchPrior moved = prior;
    moved.predicted = UncertainPose2{.T_a_b = T_map_ref} * prior.predicted;
    moved.start = T_map_ref * prior.start;
    const MatchResult here = Match(MapOf(scans.ref, {}), scans.cur, prior);
    const MatchResult there = Match(MapOf(scans.ref, T_map_ref), scans.cur, moved);
    EXPECT_LT(Apart(T_map_ref * here.T_ref_cur, there.T_ref_cur), 2e-3);
    EXPECT_NEAR(there.covariance.trace() / here.covariance.trace(), 1.0, 0.1);
  }
}

TEST(WeightedScanMatcher, OfNothingButThePriorTakesThePrior) {
  TwoScans scans(1);
  MatchPrior certain = WeakPriorAt(scans.T_ref_cur);
  certain.predicted.covariance = Eigen::Vector3d(1e-12, 1e-12, 1e-12).asDiagonal();
  certain.start = scans.T_ref_cur * Pose2{0.02, -0.02, 0.01};
  const MatchResult result = Match(MapOf(scans.ref, {}), scans.cur, certain);
  EXPECT_LT(Apart(result.T_ref_cur, scans.T_ref_cur), 1e-4);
}

TEST(WeightedScanMatcher, LeavesAlongACorridorToThePrior) {
  const Scene scene = LongCorridor();
  const Eigen::Vector2d way_m = (scene.route_m[1] - scene.route_m[0]).normalized();
  const double axis_rad = std::atan2(way_m.y(), way_m.x());
  // A quarter of the way in, neither end nor the door is within reach of this laser.
  const Eigen::Vector2d place_m = scene.route_m[0] + 12.0 * way_m;
  SimulatedLaser laser;
  laser.range_max_m = 6.0;
  Random random(3);
  const Pose2 T_world_robot{place_m.x(), place_m.y(), axis_rad};
  const LaserScan ref = Measure(laser, scene.world, T_world_robot, random);
  const LaserScan cur = Measure(laser, scene.world, T_world_robot * Pose2{0.1, 0.0, 0.0}, random);
  // Odometry says 0.25 m, give or take 0.2 m; the walls cannot tell.
  MatchPrior prior{.predicted = {{0.25, 0.0, 0.0}, Eigen::Vector3d(0.04, 0.04, 0.01).asDiagonal()},
                   .start = {0.25, 0.0, 0.0},
                   .start_error = {.translation_m = 0.1}};
  const MatchResult result = Match(MapOf(ref, {}), cur, prior);
  ASSERT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_NEAR(result.T_ref_cur.x_m, 0.25, 0.05);
  EXPECT_GT(std::sqrt(result.covariance(0, 0)), 0.15);
  EXPECT_NEAR(result.T_ref_cur.y_m, 0.0, 0.02);
  EXPECT_LT(std::sqrt(result.covariance(1, 1)), 0.02);
  EXPECT_LT(std::sqrt(result.covariance(2, 2)), 0.01);
}

// The normals of the first scan's walls are noisy, and no mean of many.
TEST(WeightedScanMatcher, NoiseOfNormalsIsNoHoldAlongACorridor) {
  const Scene scene = LongCorridor();
  const Eigen::Vector2d way_m = (scene.route_m[1] - scene.route_m[0]).normalized();
  const Pose2 T_world_robot{
      scene.route_m[0].x(), scene.route_m[0].y(), std::atan2(way_m.y(), way_m.x())};
  SimulatedLaser laser;
  laser.range_max_m = 8.0;
  const MatchPrior prior{
      .predicted = {{0.2, 0.0, 0.0}, Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal()},
      .start = {0.2, 0.0, 0.0},
      .start_error = {.translation_m = 0.02}};
  constexpr double kMostInformation = 10.0;  // 1/m^2: a sigma of 0.3 m.
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const LaserScan ref = Measure(laser, scene.world, T_world_robot, random);
    const LaserScan cur = Measure(laser, scene.world, T_world_robot * Pose2{0.2, 0.0, 0.0}, random);
    const MatchResult result = Match(MapOf(ref, {}), cur, prior);
    EXPECT_LT(DegeneracyOf(result.pair_information).weakest_information, kMostInformation);
  }
}

// Seen from anywhere in a room, and whether the map was seen once or many times.
TEST(WeightedScanMatcher, PairsTellHowFarOffAMatchIs) {
  const Scene scene = FurnishedRoom();
  for (const int observations : {1, 3}) {
    SCOPED_TRACE(observations);
    Random random(7);
    std::vector<double> nees;
    for (int i = 0; i < 150; ++i) {
      const Eigen::Vector2d place_m = scene.route_m[i % scene.route_m.size()];
      const Pose2 T_world_map{place_m.x(), place_m.y(), 0.04 * i};
      ScanMap map;
      for (int scans = 0; scans < observations; ++scans) {
        const Pose2 T_map_robot = AnyPose(random, 0.2, 0.1);
        const LaserScan scan = Measure({}, scene.world, T_world_map * T_map_robot, random);
        map.Insert(scan, ToPoints(scan), {.T_a_b = T_map_robot});
      }
      const Pose2 T_map_robot = AnyPose(random, 0.2, 0.1);
      const LaserScan scan = Measure({}, scene.world, T_world_map * T_map_robot, random);
      const MatchResult result = Match(map, scan, WeakPriorAt(T_map_robot));
      nees.push_back(*Nees({result.T_ref_cur, result.pair_information.inverse()}, T_map_robot));
    }
    const double mean = SummarizeNees(nees).mean;
    EXPECT_GT(mean, 2.0);
    EXPECT_LT(mean, 4.5);
  }
}

// The mean of what a laser sees of a trunk lies behind its bark. Compared with single points it
// would pull every scan ahead, by the same way each time.
TEST(WeightedScanMatcher, RoundTrunksDoNotPullAhead) {
  World trunks;
  for (const double bearing_rad : {-0.9, -0.5, -0.2, 0.1, 0.4, 0.8}) {
    trunks.columns.push_back(
        {.center_m = 4.0 * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad)),
         .radius_m = 0.2});
  }
  Random random(5);
  ScanMap map;
  for (int i = 0; i < 5; ++i) {
    const LaserScan scan = Measure({}, trunks, {}, random);
    map.Insert(scan, ToPoints(scan), {});
  }
  constexpr int kScans = 40;
  double ahead_m = 0.0;
  for (int i = 0; i < kScans; ++i) {
    const MatchResult result = Match(map, Measure({}, trunks, {}, random), WeakPriorAt({}));
    ASSERT_EQ(result.status, MatchStatus::kConverged);
    ahead_m += result.T_ref_cur.x_m / kScans;
  }
  EXPECT_NEAR(ahead_m, 0.0, 0.002);
}

// From far away a beam or two hit a trunk, and have no mean of their own to compare. The map, from
// nearer by, knows it well.
TEST(WeightedScanMatcher, TrunksFarAwayDoNotPullAhead) {
  World trunks;
  for (double y_m = -8.0; y_m <= 8.0; y_m += 2.0) {
    trunks.columns.push_back({.center_m = {16.0, y_m}, .radius_m = 0.25});
  }
  Random random(6);
  ScanMap map;
  for (int i = 0; i < 20; ++i) {
    const Pose2 T_map_robot = Pose2{.x_m = 11.0} * AnyPose(random, 1.0, 0.1);
    const LaserScan scan = Measure({}, trunks, T_map_robot, random);
    map.Insert(scan, ToPoints(scan), {.T_a_b = T_map_robot});
  }
  constexpr int kScans = 200;
  double ahead_m = 0.0;
  int unsettled = 0;
  for (int i = 0; i < kScans; ++i) {
    const Pose2 truth = AnyPose(random, 0.5, 0.1);
    const MatchResult result = Match(map, Measure({}, trunks, truth, random), WeakPriorAt(truth));
    ASSERT_TRUE(HasMatched(result));
    unsettled += result.status != MatchStatus::kConverged;
    ahead_m += (result.T_ref_cur.x_m - truth.x_m) / kScans;
  }
  EXPECT_NEAR(ahead_m, 0.0, 0.004);
  EXPECT_LE(unsettled, kScans / 100);
}

// Points along a wall, as a laser at the origin sees them.
std::vector<ScanPoint> WallPoints(const Wall& wall, const Eigen::Vector2d& normal) {
  constexpr double kSpacing_m = 0.01;
  const Eigen::Vector2d way_m = wall.to_m - wall.from_m;
  std::vector<ScanPoint> points;
  for (double along_m = 0.0; along_m <= way_m.norm(); along_m += kSpacing_m) {
    const Eigen::Vector2d p_m = wall.from_m + along_m * way_m.normalized();
    points.push_back({.p_robot_m = p_m,
                      .beam_robot = p_m.normalized(),
                      .normal_robot = normal,
                      .range_m = p_m.norm(),
                      .arc_m = kSpacing_m,
                      .spacing_m = kSpacing_m});
  }
  return points;
}

// Every so many of the points.
void Insert(std::span<const ScanPoint> points, std::size_t step, SurfaceMap& map) {
  for (std::size_t i = 0; i < points.size(); i += step) {
    const ScanPoint& p = points[i];
    const double spacing_m = static_cast<double>(step) * p.spacing_m;
    map.Insert({.p_map_m = p.p_robot_m, .normal_map = p.normal_robot, .spacing_m = spacing_m}, 0);
  }
}

// Of a wall that is seen for the first time, the end face of another one beside it is the nearest
// that is known: the wall would creep up to it.
TEST(WeightedScanMatcher, PairsNoWallWithAFaceAtRightAnglesToIt) {
  const Eigen::Vector2d ahead = Eigen::Vector2d::UnitX();
  const Eigen::Vector2d left = Eigen::Vector2d::UnitY();
  const std::vector<ScanPoint> opposite = WallPoints({{0.0, -1.0}, {0.5, -1.0}}, left);
  const std::vector<ScanPoint> face = WallPoints({{1.0, 0.5}, {1.0, 1.0}}, -ahead);
  SurfaceMap map;
  for (const auto& wall : {opposite, face}) Insert(wall, 1, map);
  std::vector<ScanPoint> scan = opposite;
  for (const ScanPoint& p : WallPoints({{1.03, 0.46}, {1.1, 0.46}}, -left)) scan.push_back(p);
  const MatchPrior odometry{.predicted = {{}, Eigen::Vector3d(1e-2, 1e-2, 1e-4).asDiagonal()},
                            .start = {},
                            .start_error = {.translation_m = 0.03}};
  const MatchResult result = WeightedScanMatcher().Match(map, scan, odometry);
  EXPECT_EQ(result.status, MatchStatus::kConverged);
  EXPECT_NEAR(result.T_ref_cur.x_m, 0.0, 1e-3);
}

// A corner, and of one wall more than is stored.
struct CornerSeenFurther {
  CornerSeenFurther() {
    points = WallPoints({{0.0, -1.0}, {0.98, -1.0}}, Eigen::Vector2d::UnitY());
    const auto ahead = WallPoints({{1.0, -0.98}, {1.0, 0.5}}, -Eigen::Vector2d::UnitX());
    points.insert(points.end(), ahead.begin(), ahead.end());
    further = points;
    const auto beyond = WallPoints({{1.0, 0.53}, {1.0, 0.62}}, -Eigen::Vector2d::UnitX());
    further.insert(further.end(), beyond.begin(), beyond.end());
  }

  std::vector<ScanPoint> points;
  std::vector<ScanPoint> further;
};

MatchResult Match(const SurfaceMap& map, std::span<const ScanPoint> scan, PairSelection selection) {
  WeightedScanMatcherOptions options;
  options.selection = selection;
  return WeightedScanMatcher(options).Match(map, scan, WeakPriorAt({}));
}

TEST(WeightedScanMatcher, OneToOneTakesNoPointBeyondAnEnd) {
  const CornerSeenFurther corner;
  SurfaceMap map;
  Insert(corner.points, 1, map);
  const auto pairs = [&](std::span<const ScanPoint> scan, PairSelection selection) {
    return Match(map, scan, selection).pairs;
  };
  const int stored = static_cast<int>(corner.points.size());
  const int seen = static_cast<int>(corner.further.size());
  EXPECT_EQ(pairs(corner.further, PairSelection::kEveryPoint), seen);
  EXPECT_EQ(pairs(corner.points, PairSelection::kOneToOne), stored);
  EXPECT_EQ(pairs(corner.further, PairSelection::kOneToOne), stored);
}

// However many points of a scan lie about a stored one, they tell no more than one of them does.
TEST(WeightedScanMatcher, OneToOneCountsAStoredPointOnce) {
  constexpr std::size_t kStep = 4;
  const CornerSeenFurther corner;
  std::vector<ScanPoint> every_fourth;
  for (std::size_t i = 0; i < corner.points.size(); i += kStep) {
    every_fourth.push_back(corner.points[i]);
  }
  SurfaceMap map;
  Insert(corner.points, kStep, map);
  const auto information = [&](std::span<const ScanPoint> scan, PairSelection selection) {
    const MatchResult result = Match(map, scan, selection);
    EXPECT_EQ(result.status, MatchStatus::kConverged);
    EXPECT_GT(result.overlap, 0.95);
    return result.pair_information.topLeftCorner<2, 2>().trace();
  };
  const double of_fourth = information(every_fourth, PairSelection::kOneToOne);
  EXPECT_GT(information(corner.points, PairSelection::kEveryPoint), 3.0 * of_fourth);
  EXPECT_NEAR(information(corner.points, PairSelection::kOneToOne) / of_fourth, 1.0, 0.1);
}

TEST(WeightedScanMatcher, SaysThatThereIsNothingToMatch) {
  const TwoScans scans(1);
  const ScanMap far = MapOf(scans.ref, {100.0, 100.0, 0.0});
  const MatchResult result = Match(far, scans.cur, WeakPriorAt({}));
  EXPECT_EQ(result.status, MatchStatus::kTooFewPairs);
  EXPECT_EQ(result.T_ref_cur, Pose2{});
  const MatchResult of_nothing =
      WeightedScanMatcher().Match(far.surfaces(), {}, WeakPriorAt({1.0, 2.0, 3.0}));
  EXPECT_EQ(of_nothing.status, MatchStatus::kTooFewPairs);
  EXPECT_EQ(of_nothing.T_ref_cur, (Pose2{1.0, 2.0, 3.0}));
}

TEST(WeightedScanMatcher, TracesEveryIterationAndStopsAtTheLimit) {
  const TwoScans scans(2);
  const ScanMap map = MapOf(scans.ref, {});
  WeightedScanMatcherOptions options;
  options.max_iterations = 2;
  MatchTrace trace;
  const MatchResult result =
      WeightedScanMatcher(options).Match(map.surfaces(),
                                         ToPoints(scans.cur),
                                         WeakPriorAt(scans.T_ref_cur * Pose2{0.05, 0.05, 0.02}),
                                         &trace);
  EXPECT_EQ(result.status, MatchStatus::kIterationLimit);
  EXPECT_EQ(result.iterations, 2);
  ASSERT_EQ(trace.size(), 2U);
  EXPECT_EQ(trace.back().T_ref_cur, result.T_ref_cur);
}

}  // namespace
}  // namespace qwsm::test
