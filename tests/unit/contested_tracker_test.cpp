// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// What becomes of a robot of which somebody says that it is elsewhere, or that its laser is,
// session and all.
#include "service/team/service/contested_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "service/team/service/team_service.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/room_drive.hpp"

namespace qwsm::team {
namespace {

constexpr int kRound = 126;  // Scans of one round through the room.

class ContestedTrackerOfARobot : public ::testing::Test {
 protected:
  static TeamServiceOptions Lossless() {
    TeamServiceOptions options;
    options.team.session.queue_scans = 1000;
    options.team.session.odometry_wait_s = 10.0;
    options.team.map_period_s = 0.0;
    return options;
  }

  ContestedTrackerOfARobot() : service_(Lossless(), sink_) { service_.Start(); }

  /// @param elsewhere where the robot is once it was carried away: there its scans are those of an
  /// earlier place.
  void Drive(int first,
             int count,
             int elsewhere = 0,
             const std::optional<Pose2>& claimed_mounting = {}) {
    for (int scan = first; scan < first + count; ++scan) {
      Observation observation = test::ObservationInRoom(scan);
      LaserScan seen = test::ObservationInRoom(scan + elsewhere).scan;
      seen.stamp = observation.scan.stamp;
      const Pose2 T_odom_robot = *test::ObservationInRoom(scan + elsewhere).T_odom_robot;
      service_.robots().TakeOdometry("robot1", seen.stamp, T_odom_robot);
      if (claimed_mounting) {
        EXPECT_TRUE(service_.robots().TakeContestedScan("robot1", seen, *claimed_mounting));
      } else {
        EXPECT_TRUE(service_.robots().TakeScan("robot1", seen));
      }
    }
    service_.WaitUntilIdle();
  }
  void Tell(const Pose2& T_map_robot, double sigma_m = 0.5, double sigma_rad = 0.26) {
    service_.robots().PlaceAt("robot1",
                              UncertainPose2::WithSigmas(T_map_robot, sigma_m, sigma_rad));
  }

  RobotStatus Status() const { return service_.Status().robots.at(0); }
  double ErrorAt_m(int scan) const {
    const Pose2 error = test::PoseInRoom(scan).Inverse() * Status().map_robot.T_a_b;
    return error.translation_m().norm();
  }
  /// The largest error of a scan that the map was extended with.
  double LargestErrorOfMap_m() const {
    double largest_m = 0.0;
    for (const TeamScan& scan : sink_.relevant()) {
      const auto number = static_cast<int>(scan.scan.stamp / std::chrono::milliseconds(100));
      const Pose2 error = test::PoseInRoom(number).Inverse() * scan.map_robot.T_a_b;
      largest_m = std::max(largest_m, error.translation_m().norm());
    }
    return largest_m;
  }

  static constexpr const char* kBack =
      "robot1: is not where it was told, says the map: it is back where it was tracked";

  static constexpr const char* kContested =
      "robot1: /tf_static has its laser elsewhere while it drives: its scans will tell";

  test::RecordingSink sink_;
  TeamService service_;
};

TEST_F(ContestedTrackerOfARobot, GoesBackFromAPlaceThatTheMapContradicts) {
  Drive(0, 40);
  Tell(test::PoseInRoom(40) * Pose2{3.0, 1.0, 1.0});
  Drive(40, 30);
  EXPECT_LT(ErrorAt_m(69), 0.05);
  EXPECT_TRUE(sink_.HasEvent(kBack));
  EXPECT_EQ(Status().counts.contradicted_poses, 1U);
  EXPECT_LT(LargestErrorOfMap_m(), 0.05);
}

TEST_F(ContestedTrackerOfARobot, GoesBackFromFarOutsideOfTheMap) {
  Drive(0, 40);
  Tell({19999.0, 19999.0, 0.0});
  Drive(40, 30);
  EXPECT_LT(ErrorAt_m(69), 0.05);
  EXPECT_TRUE(sink_.HasEvent(kBack));
  EXPECT_LT(LargestErrorOfMap_m(), 0.05);
  // What was held while nobody knew has come into the map.
  EXPECT_EQ(Status().counts.relevant, sink_.relevant().size());
}

TEST_F(ContestedTrackerOfARobot, GoesBackEachTimeItIsToldAgain) {
  Drive(0, 40);
  for (int scan = 40; scan < 80; ++scan) {
    Tell({30.0, -20.0, 2.0});
    Drive(scan, 1);
  }
  Drive(80, 10);
  EXPECT_LT(ErrorAt_m(89), 0.05);
  EXPECT_LT(LargestErrorOfMap_m(), 0.05);
}

TEST_F(ContestedTrackerOfARobot, BelievesWhoToldWhereARobotWasCarriedTo) {
  Drive(0, kRound);
  const int elsewhere = 50;
  Tell(test::PoseInRoom(kRound + elsewhere), 0.2, 0.1);
  Drive(kRound, 30, elsewhere);
  EXPECT_LT(ErrorAt_m(kRound + 29 + elsewhere), 0.05);
  EXPECT_EQ(Status().counts.contradicted_poses, 0U);
}

TEST_F(ContestedTrackerOfARobot, BelievesWhoToldAPlaceThatTheMapAgreesWith) {
  Drive(0, 40);
  Tell(test::PoseInRoom(40) * Pose2{0.2, -0.1, 0.05});
  Drive(40, 30);
  EXPECT_LT(ErrorAt_m(69), 0.05);
  EXPECT_EQ(Status().counts.contradicted_poses, 0U);
  EXPECT_EQ(Status().counts.relevant, sink_.relevant().size());
}

TEST_F(ContestedTrackerOfARobot, BelievesWhoCorrectsAWrongStart) {
  Drive(0, kRound);
  const Pose2 wrong{1.0, 0.5, 0.4};
  service_.robots().PlaceAt("robot2",
                            UncertainPose2::WithSigmas(test::PoseInRoom(0) * wrong, 0.02, 0.01));
  for (int scan = 0; scan < kRound; ++scan) {
    if (scan == 15) {
      service_.robots().PlaceAt("robot2",
                                UncertainPose2::WithSigmas(test::PoseInRoom(scan), 0.1, 0.05));
    }
    const Observation seen = test::ObservationInRoom(scan);
    service_.robots().TakeOdometry("robot2", seen.scan.stamp, *seen.T_odom_robot);
    service_.robots().TakeScan("robot2", seen.scan);
    service_.WaitUntilIdle();
  }
  const RobotStatus status = service_.Status().robots.at(1);
  const Pose2 error = test::PoseInRoom(kRound - 1).Inverse() * status.map_robot.T_a_b;
  EXPECT_LT(error.translation_m().norm(), 0.1);
  EXPECT_EQ(status.counts.contradicted_poses, 0U);
}

TEST_F(ContestedTrackerOfARobot, IsNotLedAstrayByWhoSaysThatItsLaserSitsElsewhere) {
  const Pose2 T_robot_laser = test::ObservationInRoom(0).scan.geometry.T_robot_laser;
  Drive(0, 40);
  Drive(40, 40, 0, T_robot_laser * Pose2{1.0, 0.0, 0.0});
  Drive(80, 40, 0, T_robot_laser * Pose2{0.0, 0.0, 1.0});
  EXPECT_EQ(Status().counts.contradicted_mountings, 2U);
  EXPECT_EQ(sink_.CountEvents(kContested), 2);
  EXPECT_EQ(
      sink_.CountEvents("robot1: its laser is not where /tf_static has it now, say its scans"), 2);
  Mapper undisturbed;
  const std::vector<MappingStep> steps = sink_.steps("robot1");
  for (int scan = 0; scan < 120; ++scan) {
    const MappingStep step = undisturbed.Process(test::ObservationInRoom(scan));
    EXPECT_EQ(steps[static_cast<std::size_t>(scan)].map_robot.T_a_b, step.map_robot.T_a_b) << scan;
  }
}

TEST_F(ContestedTrackerOfARobot, BelievesThatItsLaserWasTurnedWhereItsScansSaySo) {
  const Pose2 T_robot_laser = test::ObservationInRoom(0).scan.geometry.T_robot_laser;
  Drive(0, kRound);
  // Its scans come with where the laser sat when its frame was used first.
  const Pose2 turned{T_robot_laser.x_m, T_robot_laser.y_m, 1.2};
  for (int scan = kRound; scan < kRound + 40; ++scan) {
    Observation now = test::ObservationInRoom(scan);
    const Pose2 T_world_laser = test::PoseInRoom(scan) * turned;
    for (std::size_t beam = 0; beam < now.scan.size(); ++beam) {
      const double bearing_rad = T_world_laser.theta_rad + now.scan.geometry.Bearing(beam);
      now.scan.ranges_m[beam] =
          static_cast<float>(test::RangeInRoom_m(T_world_laser.translation_m(), bearing_rad));
    }
    service_.robots().TakeOdometry("robot1", now.scan.stamp, *now.T_odom_robot);
    service_.robots().TakeContestedScan("robot1", now.scan, turned);
  }
  service_.WaitUntilIdle();
  EXPECT_LT(ErrorAt_m(kRound + 39), 0.05);
  EXPECT_EQ(Status().counts.contradicted_mountings, 0U);
  EXPECT_TRUE(sink_.HasEvent("robot1: its laser is where /tf_static has it now, say its scans"));
}

}  // namespace
}  // namespace qwsm::team
