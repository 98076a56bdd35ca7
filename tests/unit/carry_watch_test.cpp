// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// A robot that is carried while it maps knows that it is lost, and one that drives does not.
#include "qwsm/mapping/carry_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "qwsm/mapping/mapper.hpp"
#include "qwsm/mapping/view_break.hpp"
#include "tests/support/carried.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::test {
namespace {

std::vector<Observation> DriveOf(const Scene& scene, std::uint64_t seed) {
  DriveOptions options;
  options.seed = seed;
  return DriveThrough(scene, options).observations;
}

/// What is thought after each scan.
std::vector<PlaceDoubt> Doubts(const std::vector<Observation>& observations) {
  Mapper mapper;
  CarryWatch watch{MapperOptions{}};
  std::vector<PlaceDoubt> doubts;
  for (const Observation& observation : observations) {
    const MappingStep step = mapper.Process(observation);
    doubts.push_back(watch.Look(mapper.map(), observation.scan, step));
  }
  return doubts;
}

TEST(CarryWatch, DoubtsNothingWhileTheRobotDrives) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    for (const Scene& scene : {OfficeLoop(), TwoRoomsAndCorridor(), LongCorridor()}) {
      EXPECT_EQ(std::ranges::count(Doubts(DriveOf(scene, seed)), PlaceDoubt::kNone),
                std::ssize(DriveOf(scene, seed)));
    }
  }
}

TEST(CarryWatch, KnowsThatTheRobotWasCarried) {
  const std::vector<Observation> drive = DriveOf(TwoRoomsAndCorridor(), 1);
  const LogGap gap{.first = 30, .scans = drive.size() / 2 - 30};
  const std::vector<PlaceDoubt> doubts = Doubts(Carried(drive, gap));
  const auto lost = std::ranges::find(doubts, PlaceDoubt::kLost);
  ASSERT_NE(lost, doubts.end());
  EXPECT_GT(lost - doubts.begin(), 30) << "no look suffices";
  EXPECT_LT(lost - doubts.begin(), 60);
}

// A lorry before the laser, or a reading that failed: what comes after is as it was before.
TEST(CarryWatch, DoubtsNothingForAScanThatShowsSomethingElse) {
  std::vector<Observation> drive = DriveOf(OfficeLoop(), 1);
  for (float& range_m : drive[40].scan.ranges_m) range_m = std::min(range_m, 0.4F);
  const std::vector<PlaceDoubt> doubts = Doubts(drive);
  EXPECT_EQ(std::ranges::count(doubts, PlaceDoubt::kNone), std::ssize(doubts));
}

// A correction moves the map and the robot in it, and what is seen stays the same.
TEST(CarryWatch, AsksNothingWhereTheMapIsCorrected) {
  Mapper mapper;
  CarryWatch watch{MapperOptions{}};
  const Pose2 T_new_old{0.9, -0.6, 0.05};
  const std::vector<Observation> drive = DriveOf(OfficeLoop(), 1);
  for (std::size_t i = 0; i < 60; ++i) {
    if (i == 40) {
      ScanMap corrected(mapper.map().options());
      for (const RelevantScan& scan : mapper.map().scans()) {
        const UncertainPose2 map_robot = UncertainPose2{.T_a_b = T_new_old} * scan.map_robot;
        corrected.Insert(scan.scan, ToPoints(scan.scan), map_robot);
      }
      mapper.GoOnIn(std::move(corrected), UncertainPose2{.T_a_b = T_new_old} * mapper.map_robot());
      watch.Move(T_new_old);
    }
    const MappingStep step = mapper.Process(drive[i]);
    EXPECT_EQ(watch.Look(mapper.map(), drive[i].scan, step), PlaceDoubt::kNone) << i;
    EXPECT_FALSE(watch.is_asking()) << i;
  }
}

// Where a loop closes the map as it was drawn until then lies beside, and explains less.
TEST(ViewBreak, IsNoneWhereALoopCloses) {
  MappingStep step{.status = StepStatus::kMatched};
  step.match.overlap = 1.0;
  ViewBreak view;
  EXPECT_FALSE(view.Take(step));
  step.match.overlap = 0.7;
  step.map_robot.T_a_b.x_m = 0.6;
  step.closed_loop = true;
  EXPECT_FALSE(view.Take(step));
  EXPECT_FALSE(view.Take(step));

  step.closed_loop = false;
  step.map_robot.T_a_b.x_m = 0.0;
  EXPECT_TRUE(view.Take(step));
}

}  // namespace
}  // namespace qwsm::test
