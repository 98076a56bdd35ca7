// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/team/service/team_service.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/sensor/deskew.hpp"
#include "service/io/maps/map_file.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/team_in_room.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

using namespace std::chrono_literals;

using test::Give;
using test::LosslessOptions;
using test::StatusOf;

constexpr int kScans = 120;

TEST(TeamService, AnswersARobotBitForBitAsTheMapperDoes) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  Give(service, "robot1", 0, kScans);
  service.WaitUntilIdle();
  service.Stop();

  Mapper mapper;
  const std::vector<MappingStep> steps = sink.steps("robot1");
  ASSERT_EQ(steps.size(), kScans);
  for (int scan = 0; scan < kScans; ++scan) {
    SCOPED_TRACE(scan);
    const MappingStep& answer = steps[static_cast<std::size_t>(scan)];
    const MappingStep step = mapper.Process(test::ObservationInRoom(scan));
    EXPECT_EQ(answer.stamp, step.stamp);
    EXPECT_EQ(answer.map_robot.T_a_b, step.map_robot.T_a_b);
    EXPECT_EQ(answer.map_robot.covariance, step.map_robot.covariance);
    EXPECT_EQ(answer.relevant, step.relevant);
  }
  EXPECT_EQ(io::EncodeMap(service.MapOf("robot1")->Read()->map), io::EncodeMap(mapper.map()));
  EXPECT_EQ(sink.relevant().size(), mapper.map().scans().size());
  EXPECT_GT(sink.new_points(), 0U);
}

TEST(TeamService, ThinsScansThatAreTooHeavyAndSaysSoOnce) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.session.max_readings = 200;
  TeamService service(options, sink);
  service.Start();
  for (int scan = 0; scan < 5; ++scan) {
    Observation observation = test::ObservationInRoom(scan);
    LaserScan& heavy = observation.scan;
    std::vector<float> ranges_m;
    for (const float range_m : heavy.ranges_m) ranges_m.insert(ranges_m.end(), 50, range_m);
    heavy.ranges_m = ranges_m;
    heavy.geometry.bearing_step_rad /= 50.0F;
    EXPECT_TRUE(service.robots().TakeScan("robot1", heavy));
  }
  service.WaitUntilIdle();
  Give(service, "robot2", 0, 1);
  service.WaitUntilIdle();
  EXPECT_EQ(StatusOf(service, "robot1").counts.answered, 5U);
  EXPECT_EQ(sink.relevant().front().scan.size(), 197U);  // One in 46 of 9050.
  EXPECT_EQ(
      sink.CountEvents("robot1: sends more readings in a scan than team.session.max_readings: "
                       "one in 46 is used"),
      1);
  EXPECT_FALSE(
      sink.HasEvent("robot2: sends more readings in a scan than "
                    "team.session.max_readings: one in 1 is used"));
}

// A scan whose beams took 0.1 s while the robot turned, and the first one in the map.
LaserScan ScanInMap(const LaserScan& scan, const Pose2& T_first_last, bool deskew) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.session.deskew = deskew;
  TeamService service(options, sink);
  service.Start();
  service.robots().TakeOdometry("robot1", scan.stamp, {});
  EXPECT_TRUE(service.robots().TakeScan("robot1", scan));
  service.robots().TakeOdometry("robot1", scan.stamp + scan.sweep, T_first_last);
  service.WaitUntilIdle();
  service.Stop();
  EXPECT_EQ(sink.relevant().size(), 1U);
  return sink.relevant().front().scan;
}

TEST(TeamService, PutsBeamsWhereTheyWereMeasured) {
  const Pose2 T_first_last{0.02, 0.0, 0.2};
  LaserScan scan = test::ObservationInRoom(0).scan;
  scan.sweep = 100ms;
  const LaserScan expected = Deskewed(scan, T_first_last);
  ASSERT_NE(expected.geometry, scan.geometry);
  const LaserScan still = ScanInMap(scan, T_first_last, true);
  EXPECT_EQ(still.geometry, expected.geometry);
  EXPECT_EQ(still.sweep, 0ms);
  EXPECT_EQ(ScanInMap(scan, T_first_last, false).geometry, scan.geometry);
}

// Level for twenty seconds, then the nose sinks to 0.1 rad.
void Sink(RobotListener<Planar>& robots, Timestamp until) {
  for (Timestamp stamp = until - 30s; stamp < until + 50ms; stamp += 10ms) {
    const std::chrono::duration<double> sinking = stamp - (until - 10s);
    const double pitch_rad = std::clamp(0.01 * sinking.count(), 0.0, 0.1);
    robots.TakeImu("robot1",
                   {.stamp = stamp,
                    .acceleration_mps2 = Eigen::Vector3d(
                        -9.81 * std::sin(pitch_rad), 0.0, 9.81 * std::cos(pitch_rad))});
  }
}

TEST(TeamService, LeavesOutBeamsThatHitTheFloorWhereAScanTellsHowHighItWasTaken) {
  for (const double height_m : {0.0, 0.2}) {
    test::RecordingSink sink;
    TeamService service(LosslessOptions(), sink);
    service.Start();
    LaserScan scan = test::ObservationInRoom(0).scan;
    scan.stamp += 100s;
    scan.height_m = height_m;
    Sink(service.robots(), scan.stamp);
    EXPECT_TRUE(service.robots().TakeScan("robot1", scan));
    service.WaitUntilIdle();
    service.Stop();
    ASSERT_EQ(sink.relevant().size(), 1U);
    const std::vector<float> ranges_m = sink.relevant().front().scan.ranges_m;
    const auto left_out =
        std::ranges::count_if(ranges_m, [](float range_m) { return std::isnan(range_m); });
    EXPECT_EQ(left_out > 0, height_m > 0.0) << left_out;
  }
}

TEST(TeamService, CountsEveryScanThatIsDroppedForNewerOnes) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.session.queue_scans = 3;
  TeamService service(options, sink);
  Give(service, "robot1", 0, 10);  // Before the start: all have to wait.
  service.Start();
  service.WaitUntilIdle();
  const RobotStatus status = StatusOf(service, "robot1");
  EXPECT_EQ(status.counts.scans, 10U);
  EXPECT_EQ(status.counts.dropped, 7U);
  EXPECT_EQ(status.counts.answered, 3U);
  ASSERT_EQ(sink.steps("robot1").size(), 3U);
  EXPECT_EQ(sink.steps("robot1").front().stamp, test::ObservationInRoom(7).scan.stamp);
}

TEST(TeamService, AnswersOvertakenScansInTheOrderTheyCome) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  const std::vector<int> order{0, 1, 3, 2, 6, 4, 5, 7, 8};
  for (const int scan : order) Give(service, "robot1", scan, 1);
  service.WaitUntilIdle();
  service.Stop();

  Mapper mapper;
  const std::vector<MappingStep> steps = sink.steps("robot1");
  ASSERT_EQ(steps.size(), order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    SCOPED_TRACE(i);
    const MappingStep step = mapper.Process(test::ObservationInRoom(order[i]));
    EXPECT_EQ(steps[i].stamp, step.stamp);
    EXPECT_EQ(steps[i].map_robot.T_a_b, step.map_robot.T_a_b);
  }
  EXPECT_EQ(StatusOf(service, "robot1").counts.late, 3U);
}

TEST(TeamService, RefusesAndCountsDuplicatesWrongTimesAndMalformedScans) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  const LaserScan scan = test::ObservationInRoom(18).scan;
  EXPECT_TRUE(service.robots().TakeScan("robot1", scan));
  EXPECT_FALSE(service.robots().TakeScan("robot1", scan));
  EXPECT_FALSE(service.robots().TakeScan("robot1", test::ObservationInRoom(5).scan));
  LaserScan future = test::ObservationInRoom(19).scan;
  future.stamp = std::chrono::system_clock::now().time_since_epoch() + std::chrono::hours(2);
  EXPECT_FALSE(service.robots().TakeScan("robot1", future));
  LaserScan malformed = test::ObservationInRoom(19).scan;
  malformed.geometry.bearing_step_rad = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(service.robots().TakeScan("robot1", malformed));
  const SessionCounts counts = StatusOf(service, "robot1").counts;
  EXPECT_EQ(counts.scans, 5U);
  EXPECT_EQ(counts.duplicates, 1U);
  EXPECT_EQ(counts.wrong_time, 2U);
  EXPECT_EQ(counts.malformed, 1U);
}

TEST(TeamService, LetsALostRobotComeBackWhereItLeftThoughItsOdometryBeganAnew) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  Give(service, "robot1", 0, 60);
  service.WaitUntilIdle();
  service.robots().Lose("robot1");
  EXPECT_EQ(StatusOf(service, "robot1").state, RobotState::kLost);

  const Pose2 T_odom_start = test::PoseInRoom(60);
  for (int scan = 60; scan < 80; ++scan) {
    const Observation observation = test::ObservationInRoom(scan);
    service.robots().TakeOdometry(
        "robot1", observation.scan.stamp, T_odom_start.Inverse() * *observation.T_odom_robot);
    service.robots().TakeScan("robot1", observation.scan);
  }
  service.WaitUntilIdle();
  const RobotStatus status = StatusOf(service, "robot1");
  EXPECT_EQ(status.state, RobotState::kTracked);
  EXPECT_EQ(status.counts.dead_reckoned, 0U);
  const Pose2 error = test::PoseInRoom(79).Inverse() * status.map_robot.T_a_b;
  EXPECT_LT(error.translation_m().norm(), 0.05);
}

TEST(TeamService, LeavesOutScansFromBeforeTheOdometryThatIsPublished) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  service.robots().ExpectOdometry("robot1", true);
  EXPECT_TRUE(service.robots().TakeScan("robot1", test::ObservationInRoom(0).scan));
  Give(service, "robot1", 1, 5);
  service.WaitUntilIdle();
  ASSERT_EQ(sink.steps("robot1").size(), 5U);
  EXPECT_EQ(sink.steps("robot1").front().stamp, test::ObservationInRoom(1).scan.stamp);
  EXPECT_EQ(StatusOf(service, "robot1").counts.unplaced, 1U);
}

TEST(TeamService, FirstScanWaitsLongerForOdometryThanOthers) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.session.odometry_wait_s = 0.0;
  TeamService service(options, sink);
  service.Start();
  service.robots().ExpectOdometry("robot1", true);
  EXPECT_TRUE(service.robots().TakeScan("robot1", test::ObservationInRoom(0).scan));
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  Give(service, "robot1", 1, 5);
  service.WaitUntilIdle();
  EXPECT_EQ(sink.steps("robot1").size(), 5U);
  EXPECT_EQ(StatusOf(service, "robot1").counts.without_odometry, 0U);
}

TEST(TeamService, AnswersWithoutOdometryWhereItsPublisherIsSilent) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.session.odometry_wait_s = 0.05;
  TeamService service(options, sink);
  service.Start();
  service.robots().ExpectOdometry("robot1", true);
  for (int scan = 0; scan < 5; ++scan) {
    EXPECT_TRUE(service.robots().TakeScan("robot1", test::ObservationInRoom(scan).scan));
  }
  service.WaitUntilIdle();
  EXPECT_EQ(StatusOf(service, "robot1").counts.without_odometry, 5U);
}

TEST(TeamService, ScanThatWaitsOutlivesItsRobotsAbsence) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  service.robots().ExpectOdometry("robot1", true);
  Give(service, "robot1", 0, 5);
  service.WaitUntilIdle();
  const Observation waiting = test::ObservationInRoom(5);
  EXPECT_TRUE(service.robots().TakeScan("robot1", waiting.scan));
  service.robots().Lose("robot1");
  service.robots().Join("robot1");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  service.robots().TakeOdometry("robot1", waiting.scan.stamp, *waiting.T_odom_robot);
  service.WaitUntilIdle();
  EXPECT_EQ(sink.steps("robot1").size(), 6U);
  EXPECT_EQ(StatusOf(service, "robot1").counts.without_odometry, 0U);
}

TEST(TeamService, GivesNoNumberTwiceThoughTheJournalForgotSome) {
  const test::TemporaryFolder folder;
  const std::filesystem::path journal = folder.path() / "team.db";
  const std::filesystem::path copy = folder.path() / "copy.db";
  std::vector<ScanKey> keys;
  const auto serve = [&](int first) {
    test::RecordingSink sink;
    TeamService service(LosslessOptions(), sink, journal);
    service.Start();
    Give(service, "robot1", first, 40);
    service.WaitUntilIdle();
    service.Stop();
    for (const TeamScan& scan : sink.relevant()) keys.push_back(scan.key);
  };
  serve(0);
  const std::size_t stored = keys.size();
  std::filesystem::copy_file(journal, copy);
  serve(40);
  std::filesystem::rename(copy, journal);
  serve(80);
  // The first ones are offered anew by every run.
  const std::set<ScanKey> different(keys.begin(), keys.end());
  EXPECT_GT(stored, 0U);
  EXPECT_EQ(different.size(), keys.size() - 2 * stored);
}

TEST(TeamService, StartsARobotWhereItIsTold) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.robots.push_back({.name = "robot1", .x_m = 3.0, .y_m = -2.0});
  TeamService service(options, sink);
  service.Start();
  service.robots().TakeScan("robot1", test::ObservationInRoom(0).scan);
  service.WaitUntilIdle();
  EXPECT_EQ(sink.steps("robot1").at(0).map_robot.T_a_b, (Pose2{3.0, -2.0, 0.0}));
}

TEST(TeamService, KeepsAMapForEachRobotWhereAsked) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.map = MapSharing::kEachRobot;
  TeamService service(options, sink);
  service.Start();
  Give(service, "robot1", 0, 20);
  Give(service, "robot2", 0, 20);
  service.WaitUntilIdle();
  EXPECT_EQ(io::EncodeMap(service.MapOf("robot1")->Read()->map),
            io::EncodeMap(service.MapOf("robot2")->Read()->map));
}

TEST(TeamService, TakesInWhatOtherServicesShareOnceAndInOneOrder) {
  test::RecordingSink of_first;
  TeamService first(LosslessOptions(), of_first);
  first.Start();
  Give(first, "robot1", 0, kScans);
  first.WaitUntilIdle();

  std::vector<TeamScan> shared = of_first.relevant();
  std::ranges::reverse(shared);
  shared.push_back(shared.front());
  shared.push_back(shared.front());
  shared.back().key.sequence = 1000;
  shared.back().map_robot.T_a_b.x_m = 1e300;
  test::RecordingSink of_second;
  TeamService second(LosslessOptions(), of_second);
  second.TakeIn(shared);
  EXPECT_EQ(io::EncodeMap(second.MapOf("robot1")->Read()->map),
            io::EncodeMap(first.MapOf("robot1")->Read()->map));
  const MapStatus status = second.Status().map;
  EXPECT_EQ(status.taken_in, shared.size() - 2);
  EXPECT_EQ(status.duplicates, 1U);
  EXPECT_EQ(status.refused, 1U);
}

TEST(TeamService, DrawsTheMapAndTellsItsStateAgainAndAgain) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.map_period_s = 0.01;
  options.team.status_period_s = 0.01;
  TeamService service(options, sink);
  service.Start();
  Give(service, "robot1", 0, 20);
  service.WaitUntilIdle();
  while (sink.maps().empty() || sink.statuses() < 3) std::this_thread::yield();
  EXPECT_GT(sink.maps().at("").width, 100);
}

}  // namespace
}  // namespace qwsm::team
