// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot that nobody placed is found in a map, or is known to be lost.
#include "qwsm/mapping/localizer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm {
namespace {

using namespace test;

SimulatedDrive DriveOf(const Scene& scene, std::uint64_t seed) {
  DriveOptions options;
  options.seed = seed;
  return DriveThrough(scene, options);
}

ScanMap MapOfDrive(const SimulatedDrive& drive) {
  Mapper mapper({}, ScanMap(), {.T_a_b = drive.T_world_robot.front()});
  for (const Observation& observation : drive.observations) mapper.Process(observation);
  return mapper.map();
}

/// The part of a drive from a scan on.
SimulatedDrive From(const SimulatedDrive& drive, std::ptrdiff_t first) {
  return {.observations = {drive.observations.begin() + first, drive.observations.end()},
          .T_world_robot = {drive.T_world_robot.begin() + first, drive.T_world_robot.end()}};
}

struct Answer {
  MappingStep step;
  double off_m = 0.0;  ///< Of the true pose, where the robot is not lost.
};

std::vector<Answer> Localized(const SimulatedDrive& drive, Localizer& localizer) {
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < drive.observations.size(); ++i) {
    answers.push_back({.step = localizer.Process(drive.observations[i])});
    const Pose2& T_map_robot = answers.back().step.map_robot.T_a_b;
    answers.back().off_m =
        (T_map_robot.translation_m() - drive.T_world_robot[i].translation_m()).norm();
  }
  return answers;
}

MapperOptions InTheMapAsItIs() {
  MapperOptions options;
  options.extend_map = false;
  return options;
}

bool IsLost(const Answer& answer) { return answer.step.status == StepStatus::kLost; }

TEST(Localizer, FindsARobotThatStartsAnywhere) {
  const ScanMap map = MapOfDrive(DriveOf(TwoRoomsAndCorridor(), 1));
  const SimulatedDrive again = DriveOf(TwoRoomsAndCorridor(), 2);
  for (const std::ptrdiff_t first : {0, 25, 60}) {
    SCOPED_TRACE(first);
    Localizer localizer(InTheMapAsItIs(), map);
    const std::vector<Answer> answers = Localized(From(again, first), localizer);
    EXPECT_TRUE(IsLost(answers.front()));
    EXPECT_FALSE(IsLost(answers.back()));
    for (const Answer& answer : answers) {
      EXPECT_TRUE(IsLost(answer) || answer.off_m < 0.25) << answer.off_m;
    }
  }
}

TEST(Localizer, BeginsWhereItIsTold) {
  const SimulatedDrive drive = DriveOf(FurnishedRoom(), 1);
  Localizer localizer(
      InTheMapAsItIs(), MapOfDrive(drive), UncertainPose2{.T_a_b = drive.T_world_robot.front()});
  for (const Answer& answer : Localized(drive, localizer)) {
    EXPECT_FALSE(IsLost(answer));
    EXPECT_LT(answer.off_m, 0.15);
  }
}

TEST(Localizer, FindsNothingInTheMapOfAnotherPlace) {
  Localizer localizer(InTheMapAsItIs(), MapOfDrive(DriveOf(FurnishedRoom(), 1)));
  const std::vector<Answer> answers = Localized(DriveOf(OfficeLoop(), 2), localizer);
  EXPECT_TRUE(std::ranges::all_of(answers, IsLost));
  EXPECT_FALSE(std::ranges::any_of(answers, [](const Answer& a) { return a.step.relevant; }));
}

// Where one place is like the next, none of them is claimed.
TEST(Localizer, ClaimsNoPlaceInACorridorThatIsEverywhereAlike) {
  const ScanMap map = MapOfDrive(DriveOf(LongCorridor(), 1));
  const SimulatedDrive again = From(DriveOf(LongCorridor(), 2), 20);
  Localizer localizer(InTheMapAsItIs(), map);
  for (const Answer& answer : Localized(again, localizer)) {
    EXPECT_TRUE(IsLost(answer) || answer.off_m < 1.0) << answer.off_m;
  }
}

/// A corridor of 24 m by 2 m, the ends of which are alike.
Scene AlikeEnds(std::vector<Eigen::Vector2d> route_m) {
  Scene scene{.world = {}, .route_m = std::move(route_m)};
  const std::vector<Eigen::Vector2d> corners_m = {{0, 0}, {24, 0}, {24, 2}, {0, 2}, {0, 0}};
  for (std::size_t i = 1; i < corners_m.size(); ++i) {
    scene.world.walls.push_back({.from_m = corners_m[i - 1], .to_m = corners_m[i]});
  }
  return scene;
}

// Whoever mapped the corridor began with his back to one of its ends, and never saw it. To the
// robot that looks at it, it is like the other one, as long as nothing else comes into view.
TEST(Localizer, ClaimsNoPlaceByWhatItSawFromTheBeginning) {
  const ScanMap map = MapOfDrive(DriveThrough(AlikeEnds({{1, 1}, {22, 1}}), {}));
  const SimulatedDrive back = DriveThrough(AlikeEnds({{7, 1}, {1.5, 1}}), {.seed = 2});
  Localizer localizer(InTheMapAsItIs(), map);
  for (const Answer& answer : Localized(back, localizer)) EXPECT_TRUE(IsLost(answer));
  EXPECT_GT(localizer.belief().looks, 3);
}

// Somebody carries the robot elsewhere; its wheels do not turn meanwhile.
TEST(Localizer, NoticesThatTheRobotWasCarriedAndFindsItAgain) {
  const ScanMap map = MapOfDrive(DriveOf(TwoRoomsAndCorridor(), 1));
  SimulatedDrive drive = DriveOf(TwoRoomsAndCorridor(), 2);
  const std::size_t carried_at = 30;
  const std::size_t carried_to = drive.observations.size() / 2;
  const Pose2 T_odom_there = *drive.observations[carried_to].T_odom_robot;
  const Pose2 T_odom_here = *drive.observations[carried_at].T_odom_robot;
  SimulatedDrive there = From(drive, static_cast<std::ptrdiff_t>(carried_to));
  for (Observation& observation : there.observations) {
    observation.T_odom_robot = T_odom_here * (T_odom_there.Inverse() * *observation.T_odom_robot);
  }
  drive.observations.resize(carried_at);
  drive.T_world_robot.resize(carried_at);

  Localizer localizer(InTheMapAsItIs(), map, UncertainPose2{.T_a_b = drive.T_world_robot.front()});
  for (const Answer& answer : Localized(drive, localizer)) EXPECT_FALSE(IsLost(answer));
  const std::vector<Answer> after = Localized(there, localizer);
  EXPECT_TRUE(std::ranges::any_of(after, IsLost));
  EXPECT_FALSE(IsLost(after.back()));
  EXPECT_LT(after.back().off_m, 0.25);
}

// What the robot saw before it was found is in the map in the end, at its place.
TEST(Localizer, GoesOnWithTheMapOnceItIsFound) {
  const ScanMap map = MapOfDrive(From(DriveOf(TwoRoomsAndCorridor(), 1), 40));
  const SimulatedDrive again = DriveOf(TwoRoomsAndCorridor(), 2);
  Localizer localizer({}, map);
  const std::vector<Answer> answers = Localized(From(again, 40), localizer);
  ASSERT_TRUE(IsLost(answers.front()));
  ASSERT_FALSE(IsLost(answers.back()));
  const std::span<const RelevantScan> scans = localizer.map().scans();
  ASSERT_GT(scans.size(), map.scans().size() + 10);
  for (const RelevantScan& scan : scans.subspan(map.scans().size())) {
    const auto taken = std::ranges::find(
        again.observations, scan.scan.stamp, [](const Observation& o) { return o.scan.stamp; });
    ASSERT_NE(taken, again.observations.end());
    const Pose2& truth =
        again.T_world_robot[static_cast<std::size_t>(taken - again.observations.begin())];
    EXPECT_LT((scan.map_robot.T_a_b.translation_m() - truth.translation_m()).norm(), 0.25);
  }
}

TEST(Localizer, LooksOnThroughScansThatShowNothing) {
  const SimulatedDrive drive = DriveOf(FurnishedRoom(), 1);
  Localizer localizer(InTheMapAsItIs(), MapOfDrive(drive));
  Observation blind = drive.observations.front();
  std::ranges::fill(blind.scan.ranges_m, std::numeric_limits<float>::infinity());
  for (int i = 0; i < 5; ++i) EXPECT_EQ(localizer.Process(blind).status, StepStatus::kLost);
  EXPECT_FALSE(IsLost(Localized(drive, localizer).back()));
}

}  // namespace
}  // namespace qwsm
