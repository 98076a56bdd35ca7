// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/scan_locator.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

/// A corridor along x in which someone stands before the robot.
World CorridorWithSomeoneAt(double x_m) {
  return {.walls = {{.from_m = {-40.0, 1.0}, .to_m = {60.0, 1.0}},
                    {.from_m = {-40.0, -1.0}, .to_m = {60.0, -1.0}}},
          .columns = {{.center_m = {x_m, 0.2}, .radius_m = 0.25}}};
}

LaserScan ScanOf(const World& world, const Pose2& T_world_robot) {
  std::mt19937_64 random(3);
  return Measure({.beams = 181, .range_max_m = 20.0}, world, T_world_robot, random);
}

ScanMap MapOfScan(const LaserScan& scan, const Pose2& T_map_robot) {
  ScanMap map;
  map.Insert(scan, ToPoints(scan), {.T_a_b = T_map_robot});
  return map;
}

UncertainPose2 Expected(const Pose2& pose, double sigma_m) {
  return UncertainPose2::WithSigmas(pose, sigma_m, 0.3 * sigma_m);
}

/// Someone who stood at 3 m has walked further than the robot has driven.
class WalkingAhead : public testing::Test {
 protected:
  static constexpr double kWay_m = 0.05;  // Of the robot from one scan to the next.
  static constexpr double kWalk_m = 0.13;

  WalkingAhead()
      : map_(MapOfScan(ScanOf(CorridorWithSomeoneAt(3.0), {}), {})),
        points_(ToPoints(ScanOf(CorridorWithSomeoneAt(3.0 + kWalk_m), truth_))) {}

  double ErrorAlong(const FreeSpace& seen_free) const {
    constexpr double kSlip_m = 0.05;
    return ScanLocator().Locate(map_, points_, Expected(truth_, kSlip_m), seen_free).T_ref_cur.x_m -
           truth_.x_m;
  }

  Pose2 truth_{kWay_m, 0.0, 0.0};
  ScanMap map_;
  std::vector<ScanPoint> points_;
};

TEST_F(WalkingAhead, DragsThePoseAlongWhereNobodySawTheWayFree) {
  EXPECT_LT(ErrorAlong(FreeSpace{}), -0.04);
}

TEST_F(WalkingAhead, DoesNotWhereTheWayWasSeenFree) {
  FreeSpace seen_free;
  World before = CorridorWithSomeoneAt(12.0);
  before.walls.push_back({.from_m = {14.0, -1.0}, .to_m = {14.0, 1.0}});  // A door, then closed.
  seen_free.Add(ScanOf(before, {}), {});
  EXPECT_NEAR(ErrorAlong(seen_free), 0.0, 0.02);
}

TEST_F(WalkingAhead, DoesNotWhereOdometryHasProvedBetterThanThat) {
  const PosePrediction predicted{.conservative = Expected(truth_, 0.05),
                                 .adapted = Expected(truth_, 0.005)};
  EXPECT_NEAR(ScanLocator().Locate(map_, points_, predicted).T_ref_cur.x_m, truth_.x_m, 0.01);
}

/// The same close before a depth camera, which sees hardly more than that somebody, by a hundred
/// points.
TEST(WalkingAheadOfACamera, DoesNotDragThePoseAlong) {
  constexpr double kStart_m = 2.0;
  const auto scan_of = [](double x_m, const Pose2& T_world_robot) {
    std::mt19937_64 random(3);
    return Measure({.beams = 640, .field_of_view_rad = 1.2, .range_max_m = 6.0},
                   CorridorWithSomeoneAt(x_m),
                   T_world_robot,
                   random);
  };
  const ScanMap map = MapOfScan(scan_of(kStart_m, {}), {});
  const Pose2 truth{0.02, 0.0, 0.0};
  for (const double walk_m : {0.13, 0.15, 0.2}) {
    const std::vector<ScanPoint> points = ToPoints(scan_of(kStart_m + walk_m, truth));
    const PosePrediction predicted{.conservative = Expected(truth, 0.05),
                                   .adapted = Expected(truth, 0.006)};
    const MatchResult match = ScanLocator().Locate(map, points, predicted);
    EXPECT_NEAR(match.T_ref_cur.x_m, truth.x_m, 0.15 * walk_m) << walk_m;
    EXPECT_NEAR(match.T_ref_cur.theta_rad, 0.0, 0.003) << walk_m;
  }
}

/// Odometry that was good to millimetres, in a room.
class ProvedOdometry : public testing::Test {
 protected:
  MatchResult Locate(const Pose2& truth) const {
    const PosePrediction predicted{.conservative = Expected({}, 0.1),
                                   .adapted = Expected({}, 0.005)};
    return ScanLocator().Locate(map_, ToPoints(ScanOf(world_, truth)), predicted);
  }

  World world_ = [] {
    World room = CorridorWithSomeoneAt(3.0);
    room.walls.push_back({.from_m = {5.0, -1.0}, .to_m = {5.0, 1.0}});
    return room;
  }();
  ScanMap map_ = MapOfScan(ScanOf(world_, {}), {});
};

TEST_F(ProvedOdometry, IsNotBelievedWhereTheWheelsHaveSlipped) {
  const Pose2 truth{0.2, 0.02, 0.03};
  const MatchResult match = Locate(truth);
  EXPECT_NEAR((match.T_ref_cur.translation_m() - truth.translation_m()).norm(), 0.0, 0.01);
  EXPECT_NEAR(match.T_ref_cur.theta_rad, truth.theta_rad, 0.005);
  EXPECT_GT(match.predicted.SigmaXY_m(), 0.05) << "by what a slip would do";
}

TEST_F(ProvedOdometry, HoldsThePoseWhereTheyHaveNot) {
  const Pose2 truth{0.004, 0.0, 0.0};
  const MatchResult match = Locate(truth);
  EXPECT_NEAR((match.T_ref_cur.translation_m() - truth.translation_m()).norm(), 0.0, 0.005);
  EXPECT_LT(match.predicted.SigmaXY_m(), 0.01);
}

TEST(ScanLocator, FindsAPoseFarBeyondTheFirstWindow) {
  const World world = CorridorWithSomeoneAt(3.0);
  const ScanMap map = MapOfScan(ScanOf(world, {}), {});
  const Pose2 truth{0.3, 0.1, 0.1};
  const MatchResult match =
      ScanLocator().Locate(map, ToPoints(ScanOf(world, truth)), Expected({}, 0.25));
  EXPECT_NEAR((match.T_ref_cur.translation_m() - truth.translation_m()).norm(), 0.0, 0.03);
  EXPECT_NEAR(match.T_ref_cur.theta_rad, truth.theta_rad, 0.01);
}

TEST(ScanLocator, FindsOnlyWhatExplainsAsMuchAsIsAsked) {
  const World world = CorridorWithSomeoneAt(3.0);
  const World elsewhere{.walls = {{.from_m = {4.0, -9.0}, .to_m = {-5.0, 9.0}}}, .columns = {}};
  const ScanMap map = MapOfScan(ScanOf(world, {}), {});
  const Pose2 truth{0.1, 0.05, 0.05};
  const UncertainPose2 expected = Expected({}, 0.1);
  const ScanLocator locator;
  const FreeSpace nothing_known;
  const std::vector<ScanPoint> points = ToPoints(ScanOf(world, truth));
  for (const auto& found : {locator.LocateExplaining(map, points, expected, 0.9, nothing_known),
                            locator.LocateWithin(map, points, expected, 0.9, nothing_known)}) {
    ASSERT_TRUE(found);
    EXPECT_NEAR((found->T_ref_cur.translation_m() - truth.translation_m()).norm(), 0.0, 0.03);
  }
  const std::vector<ScanPoint> others = ToPoints(ScanOf(elsewhere, truth));
  EXPECT_FALSE(locator.LocateExplaining(map, others, expected, 0.9, nothing_known));
  EXPECT_FALSE(locator.LocateWithin(map, others, expected, 0.9, nothing_known));
  EXPECT_LT(locator.Locate(map, others, expected).overlap, 0.5) << "matched nevertheless";
}

}  // namespace
}  // namespace qwsm::test
