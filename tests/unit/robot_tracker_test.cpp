// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/mapping/robot_tracker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/simulated_laser.hpp"

namespace qwsm::test {
namespace {

/// A room of 10 m by 7 m with pillars.
World Room() {
  return {.walls = {{.from_m = {-2.0, -3.0}, .to_m = {8.0, -3.0}},
                    {.from_m = {8.0, -3.0}, .to_m = {8.0, 4.0}},
                    {.from_m = {8.0, 4.0}, .to_m = {-2.0, 4.0}},
                    {.from_m = {-2.0, 4.0}, .to_m = {-2.0, -3.0}}},
          .columns = {{.center_m = {4.0, 2.0}, .radius_m = 0.3},
                      {.center_m = {6.0, -1.0}, .radius_m = 0.2}}};
}

LaserScan ScanFrom(const Pose2& T_world_robot, const World& world = Room(), unsigned seed = 3) {
  std::mt19937_64 random(seed);
  return Measure({.beams = 361, .range_max_m = 20.0}, world, T_world_robot, random);
}

/// A map of the room, made when the pose of the robot was exact.
ScanMap MapFrom(const Pose2& T_map_robot) {
  ScanMap map;
  const LaserScan scan = ScanFrom(T_map_robot);
  map.Insert(scan, ToPoints(scan), UncertainPose2::WithSigmas(T_map_robot, 0.01, 0.001));
  return map;
}

const Pose2 kStart{0.5, -0.2, 0.1};

TEST(RobotTracker, HasTheStatusOfTheLoopClosureThatReplacesABadMatch) {
  const ScanMap map = MapFrom(kStart);
  MapperOptions options;
  options.locator.matcher.max_prior_sigmas = 1.5;  // The scan fits further from the estimate.
  RobotTracker tracker(options);
  const Pose2 drifted{kStart.x_m + 0.6, kStart.y_m + 0.7, kStart.theta_rad + 0.01};
  tracker.PlaceAt(UncertainPose2::WithSigmas(drifted, 0.4, 0.02));

  const LaserScan scan = ScanFrom(kStart, Room(), 4);
  const MappingStep step = tracker.Track(map, {.scan = scan}).step;
  EXPECT_EQ(step.reason, "loop closed");
  EXPECT_EQ(step.status, StepStatus::kMatched);
  EXPECT_EQ(step.match.status, MatchStatus::kConverged);
  EXPECT_EQ(step.map_robot.T_a_b, step.match.T_ref_cur);
  EXPECT_LT((step.map_robot.T_a_b.translation_m() - kStart.translation_m()).norm(), 0.05);
}

TEST(RobotTracker, FindsAScanRelevantByMotionAloneHoweverLittleOfItAgreesWithTheMap) {
  const ScanMap map = MapFrom(kStart);
  MapperOptions options;
  options.extended_below_overlap = 1.0;
  options.relevant_translation_m = 0.5;
  RobotTracker tracker(options);
  tracker.PlaceAt(UncertainPose2::WithSigmas(kStart, 0.01, 0.001), Pose2{});
  World rearranged = Room();
  rearranged.columns.push_back({.center_m = {2.5, 0.5}, .radius_m = 0.4});
  Pose2 T_map_relevant;
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    const Pose2 T_start_robot{0.1 * i, 0.0, 0.0};
    const LaserScan scan = ScanFrom(kStart * T_start_robot, rearranged);
    const MappingStep step = tracker.Track(map, {.scan = scan, .T_odom_robot = T_start_robot}).step;
    EXPECT_EQ(step.status, StepStatus::kExtended);
    const Pose2 moved = T_map_relevant.Inverse() * step.map_robot.T_a_b;
    EXPECT_EQ(step.relevant, i == 0 || moved.translation_m().norm() > 0.5);
    if (step.relevant) T_map_relevant = step.map_robot.T_a_b;
  }
}

TEST(RobotTracker, ExtendsByThePointsThatDoNotMove) {
  const ScanMap map = MapFrom(kStart);
  RobotTracker tracker;
  tracker.PlaceAt(UncertainPose2::WithSigmas(kStart, 0.01, 0.001), Pose2{});
  World somebody = Room();
  somebody.columns.push_back({.center_m = {2.5, 0.5}, .radius_m = 0.2});
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE(i);
    const bool somebody_came = i == 2;
    const Pose2 T_start_robot{0.6 * i, 0.0, 0.0};
    LaserScan scan = ScanFrom(kStart * T_start_robot, somebody_came ? somebody : Room());
    scan.stamp = std::chrono::seconds(i);
    const TrackedScan tracked = tracker.Track(map, {.scan = scan, .T_odom_robot = T_start_robot});
    ASSERT_TRUE(tracked.step.relevant);
    const std::vector<ScanPoint> relevant = tracked.RelevantPoints();
    const std::vector<ScanPoint> stored = ToPoints(tracked.step.relevant_scan);
    EXPECT_EQ(relevant.size() == tracked.points.size(), !somebody_came);
    ASSERT_EQ(relevant.size(), stored.size());
    for (std::size_t k = 0; k < stored.size(); ++k) {
      EXPECT_EQ(relevant[k].p_robot_m, stored[k].p_robot_m);
      EXPECT_EQ(relevant[k].normal_robot, stored[k].normal_robot);
    }
  }
}

// Where the map has less drift than the robot may have gathered, one wall is like another.
TEST(RobotTracker, IsBroughtBackByTheRoomAndNotByAWallOfIt) {
  const ScanMap map = MapFrom(kStart);
  const auto look = [&](double drift_m, float range_max_m) {
    RobotTracker tracker;
    tracker.PlaceAt(UncertainPose2::WithSigmas(kStart, 0.02, 0.002), Pose2{});
    tracker.FollowCorrection(UncertainPose2::WithSigmas(kStart, drift_m, 0.02));
    LaserScan scan = ScanFrom(kStart, Room(), 4);
    scan.geometry.range_max_m = range_max_m;
    return tracker.Track(map, {.scan = scan, .T_odom_robot = Pose2{}}).step;
  };
  constexpr float kSeesAWallAndAColumn_m = 4.6F;
  EXPECT_EQ(look(0.3, kSeesAWallAndAColumn_m).status, StepStatus::kMatched);
  const MappingStep lost = look(6.0, kSeesAWallAndAColumn_m);
  EXPECT_EQ(lost.status, StepStatus::kDeadReckoned);
  EXPECT_EQ(lost.reason, "may as well be elsewhere");
  EXPECT_GT(lost.map_robot.SigmaXY_m(), 5.0);
  const MappingStep by_room = look(6.0, 20.0F);
  EXPECT_EQ(by_room.status, StepStatus::kMatched);
  EXPECT_LT(by_room.map_robot.SigmaXY_m(), 0.1);
}

// A scan comes with the odometry of the one before it, and the next one with all of the motion.
TEST(RobotTracker, FollowsTheMapWhereOdometryIsLate) {
  const ScanMap map = MapFrom(kStart);
  RobotTracker tracker;
  tracker.PlaceAt(UncertainPose2::WithSigmas(kStart, 0.01, 0.001), Pose2{});
  for (int i = 0; i < 20; ++i) {
    SCOPED_TRACE(i);
    const auto T_start_robot = [](int scan) { return Pose2{0.25 * scan, 0.0, 0.0}; };
    const Pose2 T_map_robot = kStart * T_start_robot(i);
    const bool is_late = i == 15;
    LaserScan scan = ScanFrom(T_map_robot, Room(), static_cast<unsigned>(i));
    scan.stamp = std::chrono::milliseconds(200 * i);
    const Observation observation{.scan = scan, .T_odom_robot = T_start_robot(is_late ? i - 1 : i)};
    const MappingStep step = tracker.Track(map, observation).step;
    EXPECT_EQ(step.status, StepStatus::kMatched);
    EXPECT_LT((step.map_robot.T_a_b.translation_m() - T_map_robot.translation_m()).norm(), 0.03);
  }
}

/// A robot that stands and sees somebody walk by, until it is known that he moves.
class SomebodyWalksBy : public ::testing::Test {
 protected:
  SomebodyWalksBy() {
    tracker_.PlaceAt(UncertainPose2::WithSigmas(kStart, 0.01, 0.001), Pose2{});
    for (int i = 0; i < 12; ++i) {
      somebody_m_ = {2.0 + 0.1 * i, 0.5};
      World room = Room();
      room.columns.push_back({.center_m = somebody_m_, .radius_m = 0.2});
      Look(kStart, room, Pose2{});
    }
  }

  /// @return how many points of the first pillar the robot makes use of.
  int Look(const Pose2& T_map_robot, const World& world, const Pose2& T_odom_robot) {
    LaserScan scan = ScanFrom(T_map_robot, world);
    scan.stamp = stamp_ += std::chrono::milliseconds(100);
    const TrackedScan tracked = tracker_.Track(map_, {.scan = scan, .T_odom_robot = T_odom_robot});
    int of_pillar = 0;
    for (const ScanPoint& point : tracked.points) {
      const Column pillar = Room().columns.front();
      const double off_m = (T_map_robot * point.p_robot_m - pillar.center_m).norm();
      of_pillar += off_m < pillar.radius_m + 0.1 ? 1 : 0;
    }
    return of_pillar;
  }

  /// Odometry that begins anew where the pillar is to the robot where somebody just was.
  Pose2 OdometryThatMistakesThePillar(const Pose2& T_map_robot) const {
    const Eigen::Vector2d p_odom_m = kStart.Inverse() * somebody_m_;
    const Eigen::Vector2d p_robot_m = T_map_robot.Inverse() * Room().columns.front().center_m;
    return {p_odom_m.x() - p_robot_m.x(), p_odom_m.y() - p_robot_m.y(), 0.0};
  }

  ScanMap map_ = MapFrom(kStart);
  RobotTracker tracker_;
  Timestamp stamp_{};
  Eigen::Vector2d somebody_m_ = Eigen::Vector2d::Zero();
};

TEST_F(SomebodyWalksBy, AndIsNotTakenForWhatStandsWhereTheRobotIsPutElsewhere) {
  const Pose2 elsewhere{6.0, 2.5, -2.0};
  const Pose2 T_odom_robot = OdometryThatMistakesThePillar(elsewhere);
  tracker_.PlaceAt(UncertainPose2::WithSigmas(elsewhere, 0.01, 0.001), T_odom_robot);
  EXPECT_GT(Look(elsewhere, Room(), T_odom_robot), 3);
}

TEST_F(SomebodyWalksBy, AndIsNotTakenForWhatStandsWhereOdometryBeginsAnew) {
  const Pose2 T_odom_robot = OdometryThatMistakesThePillar(kStart);
  tracker_.SuspectOdometryReset();
  Look(kStart, Room(), T_odom_robot);  // By this scan it is found out.
  EXPECT_GT(Look(kStart, Room(), T_odom_robot), 3);
}

}  // namespace
}  // namespace qwsm::test
