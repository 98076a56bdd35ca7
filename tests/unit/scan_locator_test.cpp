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

ScanMap MapOf(const LaserScan& scan, const Pose2& T_map_robot) {
  ScanMap map;
  map.Insert(scan, ToPoints(scan), {.T_a_b = T_map_robot});
  return map;
}

UncertainPose2 Expected(const Pose2& pose, double sigma_m) {
  const double sigma_rad = 0.3 * sigma_m;
  UncertainPose2 expected{.T_a_b = pose};
  expected.covariance.diagonal() = Eigen::Vector3d(sigma_m, sigma_m, sigma_rad).cwiseAbs2();
  return expected;
}

constexpr double kSlip_m = 0.05;
constexpr double kOdometrySigma_m = 0.004;

class WalkingAhead : public testing::Test {
 protected:
  static constexpr double kWay_m = 0.05;   // Of the robot from one scan to the next.
  static constexpr double kWalk_m = 0.13;  // Of the one who walks.

  WalkingAhead()
      : map_(MapOf(ScanOf(CorridorWithSomeoneAt(3.0), {}), {})),
        points_(ToPoints(ScanOf(CorridorWithSomeoneAt(3.0 + kWalk_m), truth_))) {}

  double ErrorAlong(const PosePrediction& predicted) const {
    return ScanLocator().Locate(map_, points_, predicted).T_ref_cur.x_m - truth_.x_m;
  }

  Pose2 truth_{kWay_m, 0.0, 0.0};
  ScanMap map_;
  std::vector<ScanPoint> points_;
};

TEST_F(WalkingAhead, DragsThePoseAlongWhereOdometryIsNotKnownToBeGood) {
  const UncertainPose2 cautious = Expected(truth_, kSlip_m);
  EXPECT_LT(ErrorAlong({.cautious = cautious, .learned = cautious}), -0.04);
}

TEST_F(WalkingAhead, DoesNotWhereOdometryHasProvedToBeGood) {
  EXPECT_NEAR(ErrorAlong({.cautious = Expected(truth_, kSlip_m),
                          .learned = Expected(truth_, kOdometrySigma_m)}),
              0.0,
              0.02);
}

TEST(ScanLocator, BelievesAllOfTheScanAgainstOdometryThatWasGood) {
  // A room's worth of surfaces in every direction: the wheels have slipped.
  World world = CorridorWithSomeoneAt(3.0);
  for (const double x_m : {-6.0, 8.0}) {
    world.walls.push_back({.from_m = {x_m, -1.0}, .to_m = {x_m, 1.0}});
  }
  const ScanMap map = MapOf(ScanOf(world, {}), {});
  const Pose2 truth{0.05, 0.0, 0.0};
  const Pose2 told{0.17, 0.0, 0.0};
  const MatchResult match = ScanLocator().Locate(
      map,
      ToPoints(ScanOf(world, truth)),
      {.cautious = Expected(told, kSlip_m), .learned = Expected(told, kOdometrySigma_m)});
  EXPECT_NEAR(match.T_ref_cur.x_m, truth.x_m, 0.01);
}

TEST(ScanLocator, FindsAPoseFarBeyondTheFirstWindow) {
  const World world = CorridorWithSomeoneAt(3.0);
  const ScanMap map = MapOf(ScanOf(world, {}), {});
  const Pose2 truth{0.3, 0.1, 0.1};
  const UncertainPose2 expected = Expected({}, 0.25);
  const MatchResult match = ScanLocator().Locate(
      map, ToPoints(ScanOf(world, truth)), {.cautious = expected, .learned = expected});
  EXPECT_NEAR((match.T_ref_cur.translation_m() - truth.translation_m()).norm(), 0.0, 0.03);
  EXPECT_NEAR(match.T_ref_cur.theta_rad, truth.theta_rad, 0.01);
}

}  // namespace
}  // namespace qwsm::test
