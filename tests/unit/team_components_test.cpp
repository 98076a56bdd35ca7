// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Robots that nobody placed, or that were placed wrongly, are in a component of the map of their
// own until they are found in the one that the team shares.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "service/io/maps/map_file.hpp"
#include "service/team/service/team_service.hpp"
#include "tests/support/recording_sink.hpp"
#include "tests/support/room_drive.hpp"
#include "tests/support/team_in_room.hpp"
#include "tests/support/temporary_folder.hpp"

namespace qwsm::team {
namespace {

using test::LosslessOptions;
using test::StatusOf;

/// Robots drive there one after another.
Timestamp LatenessOf(const std::string& robot) {
  return std::chrono::minutes(robot == "robot1" ? 0 : 1);
}

/// Drives a robot through the room, scan by scan.
void Drive(TeamService& service, const std::string& robot, int first, int count) {
  for (int scan = first; scan < first + count; ++scan) {
    test::Give(service, robot, scan, 1, LatenessOf(robot));
    service.WaitUntilIdle();
  }
}

double ErrorAfter_m(const RobotStatus& status, int scan) {
  return (test::PoseInRoom(scan).Inverse() * status.map_robot.T_a_b).translation_m().norm();
}

TEST(TeamComponents, AnswerARobotThatNobodyPlacedUntilItIsFoundInTheMap) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  Drive(service, "robot1", 0, 126);
  EXPECT_EQ(sink.components("robot1"), std::vector<std::string>{""});
  Drive(service, "robot2", 30, 80);
  EXPECT_TRUE(
      sink.HasEvent("robot2: begins a map of its own, map_robot2: nobody knows where in the team's "
                    "it is"));
  EXPECT_TRUE(sink.HasEvent("service: map_robot2 was found in map: its scans are there now"));
  const RobotStatus status = StatusOf(service, "robot2");
  EXPECT_EQ(status.counts.answered, 80U);  // At once, from the first one on.
  EXPECT_EQ(status.component, "");
  EXPECT_EQ(sink.components("robot2"), (std::vector<std::string>{"robot2", ""}));
  EXPECT_LT(ErrorAfter_m(status, 109), 0.05);
  EXPECT_EQ(service.MapOf("robot2"), service.MapOf("robot1"));
}

TEST(TeamComponents, TellJointsAsEpochsThatNameAllScansWithTheirFrames) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  Drive(service, "robot1", 0, 126);
  Drive(service, "robot2", 30, 80);
  const std::vector<TeamEpoch> epochs = sink.epochs();
  ASSERT_FALSE(epochs.empty());
  std::size_t joined = 0;
  for (const MovedScan& scan : epochs.front().scans) {
    EXPECT_EQ(scan.component, "");
    EXPECT_EQ(scan.component_before, scan.key.robot == "robot2" ? "robot2" : "");
    joined += scan.key.robot == "robot2" ? 1 : 0;
  }
  EXPECT_GT(joined, 0U);
  EXPECT_LT(joined, epochs.front().scans.size());
}

TEST(TeamComponents, ComeBackFromTheJournalApartOrJoinedAsTheyWere) {
  test::TemporaryFolder folder;
  const auto maps_after = [&](int scans, const std::string& journal) {
    std::vector<std::string> before;
    {
      test::RecordingSink sink;
      TeamService service(LosslessOptions(), sink, folder.path() / journal);
      service.Start();
      Drive(service, "robot1", 0, 126);
      Drive(service, "robot2", 30, scans);
      for (const char* robot : {"robot1", "robot2"}) {
        before.push_back(io::EncodeMap(service.MapOf(robot)->Read()->map));
      }
    }
    test::RecordingSink sink;
    TeamService again(LosslessOptions(), sink, folder.path() / journal);
    again.Start();
    for (const char* robot : {"robot1", "robot2"}) {
      EXPECT_EQ(io::EncodeMap(again.MapOf(robot)->Read()->map), before.front()) << robot;
      before.erase(before.begin());
    }
    return again.MapOf("robot1") == again.MapOf("robot2") ? 1 : 2;
  };
  EXPECT_EQ(maps_after(5, "apart.db"), 2);
  EXPECT_EQ(maps_after(80, "joined.db"), 1);
}

TEST(TeamComponents, AreTheSameForAServiceThatOnlyHearsOfThem) {
  test::RecordingSink told;
  TeamService finds(LosslessOptions(), told);
  finds.Start();
  Drive(finds, "robot1", 0, 126);
  Drive(finds, "robot2", 30, 80);
  ASSERT_FALSE(told.epochs().empty());
  const auto is_same = [&](TeamService& hears) {
    return hears.MapOf("robot1") == hears.MapOf("robot2") &&
           hears.MapOf("robot1")->Scans().size() == finds.MapOf("robot1")->Scans().size();
  };
  test::RecordingSink sink;
  TeamService scans_first(LosslessOptions(), sink);
  scans_first.TakeIn(told.relevant());
  scans_first.TakeIn(told.epochs().back());
  scans_first.WaitUntilIdle();
  EXPECT_TRUE(is_same(scans_first));
  TeamService epoch_first(LosslessOptions(), sink);
  epoch_first.TakeIn(told.epochs().back());
  epoch_first.WaitUntilIdle();
  epoch_first.TakeIn(told.relevant());
  EXPECT_TRUE(is_same(epoch_first));
  const std::optional<TeamScan> last = finds.MapOf("")->LastOf("robot2");
  EXPECT_EQ(scans_first.MapOf("")->LastOf("robot2")->map_robot.T_a_b, last->map_robot.T_a_b);
  EXPECT_EQ(epoch_first.MapOf("")->LastOf("robot2")->map_robot.T_a_b, last->map_robot.T_a_b);
}

TEST(TeamComponents, TakeARobotOutOfTheMapThatWasToldItsStartWrongly) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.robots.push_back({.name = "robot2", .x_m = 1.5, .y_m = 1.0, .heading_rad = 2.0});
  TeamService service(options, sink);
  service.Start();
  Drive(service, "robot1", 0, 126);
  Drive(service, "robot2", 30, 120);
  const RobotStatus status = StatusOf(service, "robot2");
  EXPECT_EQ(status.counts.answered, 120U);
  EXPECT_TRUE(sink.HasEvent("robot2: is lost: what it sees contradicts the map"));
  EXPECT_LT(ErrorAfter_m(status, 149), 0.05);
  EXPECT_EQ(service.MapOf("robot2"), service.MapOf("robot1"));
}

/// What a robot sees that was carried from where it was at one scan to where it is at another, and
/// whose wheels did not turn meanwhile.
Observation Carried(int scan, int from, int to) {
  Observation observation = test::ObservationInRoom(scan - from + to);
  observation.T_odom_robot =
      test::PoseInRoom(from) * (test::PoseInRoom(to).Inverse() * *observation.T_odom_robot);
  return observation;
}

void DriveCarried(TeamService& service, const std::string& robot, int from, int to, int count) {
  for (int scan = from; scan < from + count; ++scan) {
    Observation observation = Carried(scan, from, to);
    observation.scan.stamp = test::ObservationInRoom(scan).scan.stamp + LatenessOf(robot);
    service.robots().TakeOdometry(robot, observation.scan.stamp, *observation.T_odom_robot);
    EXPECT_TRUE(service.robots().TakeScan(robot, observation.scan));
    service.WaitUntilIdle();
  }
}

/// The second robot is placed where it takes scan 30.
TeamServiceOptions OptionsWithRobotPlaced() {
  TeamServiceOptions options = LosslessOptions();
  const Pose2 start = test::PoseInRoom(30);
  options.team.robots.push_back(
      {.name = "robot2", .x_m = start.x_m, .y_m = start.y_m, .heading_rad = start.theta_rad});
  return options;
}

/// How many scans a robot takes that was carried to where scan `to` is taken, until it is lost.
std::ptrdiff_t ScansUntilLost(int to) {
  test::RecordingSink sink;
  TeamService service(OptionsWithRobotPlaced(), sink);
  service.Start();
  Drive(service, "robot1", 0, 126);
  Drive(service, "robot2", 30, 10);
  DriveCarried(service, "robot2", 40, to, 30);
  const std::vector<MappingStep> steps = sink.steps("robot2");
  const auto carried = steps.begin() + 10;
  return std::ranges::find(carried, steps.end(), StepStatus::kLost, &MappingStep::status) - carried;
}

TEST(TeamComponents, AreMostlyBegunWithinAMetreByARobotThatIsLost) {
  std::vector<std::ptrdiff_t> scans;
  for (int to = 75; to <= 105; to += 5) scans.push_back(ScansUntilLost(to));
  const auto median = scans.begin() + 3;
  std::ranges::nth_element(scans, median);
  EXPECT_LT(*median, 15);  // A metre of way.
}

TEST(TeamComponents, AreBegunByARobotThatIsLost) {
  test::RecordingSink sink;
  TeamService service(OptionsWithRobotPlaced(), sink);
  service.Start();
  Drive(service, "robot1", 0, 126);
  Drive(service, "robot2", 30, 10);
  EXPECT_EQ(sink.components("robot2"), std::vector<std::string>{""});
  DriveCarried(service, "robot2", 40, 90, 100);
  EXPECT_TRUE(sink.HasEvent("robot2: is lost: what it sees contradicts the map"));
  EXPECT_EQ(sink.components("robot2"), (std::vector<std::string>{"", "robot2", ""}));
  const std::vector<MappingStep> steps = sink.steps("robot2");
  ASSERT_EQ(steps.size(), 110U);  // Each scan is answered, in one map or the other.
  EXPECT_EQ(steps[9].status, StepStatus::kMatched);
  const auto is_matched = [](const MappingStep& step) {
    return step.status == StepStatus::kMatched;
  };
  const auto carried = steps.begin() + 10;
  const auto lost =
      std::ranges::find(carried, steps.end(), StepStatus::kLost, &MappingStep::status);
  EXPECT_LT(lost - carried, 20);                         // A metre and a third of way.
  EXPECT_TRUE(std::none_of(carried, lost, is_matched));  // It is no guess.
  EXPECT_EQ(steps.back().status, StepStatus::kMatched);
  EXPECT_LT(ErrorAfter_m(StatusOf(service, "robot2"), 189), 0.05);
  // Nothing that it saw stands where it did not see it.
  for (const TeamScan& scan : service.MapOf("robot2")->Scans()) {
    if (scan.key.robot != "robot2") continue;
    const Timestamp in_room = scan.scan.stamp - LatenessOf("robot2");
    const auto number = static_cast<int>(in_room / std::chrono::milliseconds(100));
    const Pose2 truth = test::PoseInRoom(number < 40 ? number : number + 50);
    EXPECT_LT((truth.Inverse() * scan.map_robot.T_a_b).translation_m().norm(), 0.05) << number;
  }
}

// What it contradicts is its own map: that is mended as where its log is mapped, and in the same
// way.
TEST(TeamComponents, AreNotBegunByARobotAlone) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  Drive(service, "robot1", 0, 40);
  DriveCarried(service, "robot1", 40, 90, 30);
  EXPECT_EQ(sink.components("robot1"), std::vector<std::string>{""});
}

// Who was told its start wrongly where nobody had been yet does no harm to who comes there later.
TEST(TeamComponents, AreNotBegunByWhoSeesWhatAnotherOneHasPutInItsWay) {
  test::RecordingSink sink;
  TeamServiceOptions options = LosslessOptions();
  options.team.robots.push_back({.name = "robot2", .x_m = 1.5, .y_m = 1.0, .heading_rad = 2.0});
  TeamService service(options, sink);
  service.Start();
  Drive(service, "robot1", 0, 1);
  Drive(service, "robot2", 30, 20);
  Drive(service, "robot1", 1, 125);
  EXPECT_EQ(sink.components("robot1"), std::vector<std::string>{""});
  EXPECT_LT(ErrorAfter_m(StatusOf(service, "robot1"), 125), 0.05);
}

TEST(TeamComponents, AreNoneWhereEachRobotHasAMap) {
  test::TemporaryFolder folder;
  TeamServiceOptions options = LosslessOptions();
  options.team.map = MapSharing::kEachRobot;
  std::string before;
  {
    test::RecordingSink sink;
    TeamService service(options, sink, folder.path() / "each.db");
    service.Start();
    Drive(service, "robot1", 0, 20);
    Drive(service, "robot2", 10, 20);
    EXPECT_EQ(sink.components("robot2"), std::vector<std::string>{""});
    EXPECT_EQ(StatusOf(service, "robot2").component, "");
    before = io::EncodeMap(service.MapOf("robot2")->Read()->map);
  }
  test::RecordingSink sink;
  TeamService again(options, sink, folder.path() / "each.db");
  EXPECT_EQ(io::EncodeMap(again.MapOf("robot2")->Read()->map), before);
  EXPECT_NE(again.MapOf("robot1"), again.MapOf("robot2"));
}

TEST(TeamComponents, AreLeftByARobotThatIsToldWhereItIs) {
  test::RecordingSink sink;
  TeamService service(LosslessOptions(), sink);
  service.Start();
  Drive(service, "robot1", 0, 126);
  Drive(service, "robot2", 30, 3);
  service.robots().PlaceAt("robot2", UncertainPose2::WithSigmas(test::PoseInRoom(33), 0.05, 0.02));
  Drive(service, "robot2", 33, 2);
  EXPECT_EQ(sink.components("robot2"), (std::vector<std::string>{"robot2", ""}));
  EXPECT_LT(ErrorAfter_m(StatusOf(service, "robot2"), 34), 0.05);
}

}  // namespace
}  // namespace qwsm::team
