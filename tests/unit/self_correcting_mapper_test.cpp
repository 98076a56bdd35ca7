// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/self_correcting_mapper.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <future>
#include <memory>
#include <span>
#include <vector>

#include "qwsm/sensor/scan_points.hpp"
#include "tests/support/bent_drive.hpp"
#include "tests/support/carried.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/simulated_drive.hpp"

namespace qwsm::test {
namespace {

std::vector<Observation> OfficeDrive() {
  return DriveThrough(OfficeLoop(), {.laser = {.beams = 181, .range_max_m = 15.0}}).observations;
}

std::function<void()> OnAnotherThread(std::function<void()> work) {
  auto done = std::make_shared<std::future<void>>(std::async(std::launch::async, std::move(work)));
  return [done] { done->get(); };
}

TEST(SelfCorrectingMapper, AnswersAsTheIncrementalOneWhileTheMapIsRight) {
  SelfCorrectingMapper correcting;
  Mapper incremental;
  for (const Observation& observation : OfficeDrive()) {
    const MappingStep step = correcting.Process(observation);
    EXPECT_EQ(step.map_robot.T_a_b, incremental.Process(observation).map_robot.T_a_b);
    EXPECT_EQ(step.epoch, 0);
  }
  EXPECT_TRUE(correcting.epochs().empty());
  EXPECT_EQ(correcting.Correct().map_node.size(), incremental.map().scans().size());
}

TEST(SelfCorrectingMapper, GivesThePathOfAllScans) {
  const std::vector<Observation> drive = OfficeDrive();
  SelfCorrectingMapper mapper;
  for (const Observation& observation : drive) mapper.Process(observation);
  const Correction correction = mapper.Correct();
  EXPECT_EQ(correction.map_robot.size(), drive.size());
  const FinishedDrive finished = mapper.Finish();
  EXPECT_EQ(finished.correction.map_robot.size(), drive.size());
  EXPECT_TRUE(mapper.mapper().map().surfaces().empty());
  const std::span<const RelevantScan> answered = mapper.mapper().map().scans();
  EXPECT_EQ(answered.size(), correction.map_node.size());
  ASSERT_EQ(finished.scans.size(), answered.size());
  for (std::size_t i = 0; i < answered.size(); ++i) {
    const RelevantScan& corrected = finished.scans[i];
    EXPECT_EQ(ToPoints(corrected.scan).size(), ToPoints(answered[i].scan).size()) << i;
    EXPECT_EQ(corrected.map_robot.T_a_b, finished.correction.map_node[i].T_a_b) << i;
  }
}

TEST(SelfCorrectingMapper, DoesNotDependOnThreads) {
  SelfCorrectingMapper at_once;
  SelfCorrectingMapper beside({}, OnAnotherThread);
  for (const Observation& observation : OfficeDrive()) {
    EXPECT_EQ(at_once.Process(observation).map_robot.T_a_b,
              beside.Process(observation).map_robot.T_a_b);
  }
  const Correction one = at_once.Correct();
  const Correction other = beside.Correct();
  ASSERT_EQ(one.map_robot.size(), other.map_robot.size());
  for (std::size_t i = 0; i < one.map_robot.size(); ++i) {
    EXPECT_EQ(one.map_robot[i].T_a_b, other.map_robot[i].T_a_b) << i;
  }
}

/// A robot that drives through two rooms twice, and is carried on the way.
struct CarriedDrive {
  std::vector<Observation> observations;
  std::vector<Pose2> T_map_true;

  CarriedDrive() {
    const SimulatedDrive drive = DriveThrough(TwoRoomsAndCorridor(), {});
    const LogGap gap{.first = drive.observations.size() / 2,
                     .scans = drive.observations.size() / 3};
    observations = Carried(drive.observations, gap);
    const Pose2 T_map_world = drive.T_world_robot.front().Inverse();
    for (std::size_t i = 0; i < drive.T_world_robot.size(); ++i) {
      if (i >= gap.first && i < gap.first + gap.scans) continue;
      T_map_true.push_back(T_map_world * drive.T_world_robot[i]);
    }
  }
};

TEST(SelfCorrectingMapper, KnowsThatTheRobotWasCarried) {
  const CarriedDrive drive;
  SelfCorrectingMapper mapper;
  std::size_t lost = 0;
  for (const Observation& observation : drive.observations) {
    const MappingStep step = mapper.Process(observation);
    if (step.status != StepStatus::kLost) continue;
    EXPECT_FALSE(step.relevant);
    ++lost;
  }
  EXPECT_GE(mapper.losses(), 1U);
  EXPECT_EQ(mapper.belief(), nullptr) << "it is in the other one of the rooms that it knows";
  EXPECT_GT(lost, 0U);
  const Correction correction = mapper.Correct();
  EXPECT_EQ(correction.map_robot.size(), drive.observations.size());
  EXPECT_EQ(correction.map_node.size(), mapper.mapper().map().scans().size());
  EXPECT_LT(WorstError_m(correction.map_robot, drive.T_map_true), 0.3);
}

TEST(SelfCorrectingMapper, DoesNotDependOnThreadsWhenTheRobotIsLost) {
  const CarriedDrive drive;
  SelfCorrectingMapper at_once;
  SelfCorrectingMapper beside({}, OnAnotherThread);
  for (const Observation& observation : drive.observations) {
    const MappingStep one = at_once.Process(observation);
    const MappingStep other = beside.Process(observation);
    EXPECT_EQ(one.status, other.status);
    EXPECT_EQ(one.map_robot.T_a_b, other.map_robot.T_a_b);
  }
}

std::size_t BytesOnTheHeap() {
  const struct mallinfo2 heap = mallinfo2();
  return heap.uordblks + heap.hblkhd;
}

TEST(SelfCorrectingMapper, KeepsRelevantScansOnlyOfARobotThatIsLost) {
  const DriveOptions options{.laser = {.beams = 1081}};
  std::vector<Observation> drive = DriveThrough(FurnishedRoom(), options).observations;
  const std::vector<Observation> elsewhere = DriveThrough(OfficeLoop(), options).observations;
  const LogGap to_elsewhere{.first = drive.size(), .scans = 1};
  drive.insert(drive.end(), elsewhere.begin(), elsewhere.end());
  drive = Carried(std::move(drive), to_elsewhere);
  SelfCorrectingMapper mapper;
  auto next = drive.begin();
  while (mapper.belief() == nullptr && next != drive.end()) mapper.Process(*next++);
  ASSERT_NE(mapper.belief(), nullptr);
  for (int i = 0; i < 100; ++i) mapper.Process(*next);

  constexpr std::size_t kStanding = 500;
  const std::size_t before = BytesOnTheHeap();
  for (std::size_t i = 0; i < kStanding; ++i) mapper.Process(*next);
  const std::size_t of_scans = kStanding * next->scan.ranges_m.size() * sizeof(float);
  EXPECT_NE(mapper.belief(), nullptr);
  EXPECT_LT(BytesOnTheHeap(), before + of_scans);
}

// Where it may have been carried to, and rests before it drives on.
TEST(SelfCorrectingMapper, KeepsNoScansOfARobotThatRestsInDoubt) {
  const std::vector<Observation> whole = DriveThrough(TwoRoomsAndCorridor(), {}).observations;
  const std::size_t carried = 30;
  const std::vector<Observation> drive =
      Carried(whole, {.first = carried, .scans = whole.size() / 2 - carried});
  SelfCorrectingMapper mapper;
  std::size_t answers = 0;
  const auto process = [&](const Observation& observation) {
    ++answers;
    return mapper.Process(observation);
  };
  for (std::size_t i = 0; i < carried; ++i) process(drive[i]);
  const Observation& resting = drive[carried];
  for (int i = 0; i < 1050; ++i) process(resting);

  constexpr std::size_t kResting = 500;
  const std::size_t before = BytesOnTheHeap();
  for (std::size_t i = 0; i < kResting; ++i) process(resting);
  const std::size_t of_scans = kResting * resting.scan.ranges_m.size() * sizeof(float);
  EXPECT_LT(BytesOnTheHeap(), before + of_scans / 2);

  EXPECT_EQ(mapper.losses(), 0U) << "it is still asked where it is";
  for (std::size_t i = carried; i < drive.size() && mapper.losses() == 0; ++i) process(drive[i]);
  EXPECT_EQ(mapper.losses(), 1U);
  EXPECT_EQ(mapper.Correct().map_robot.size(), answers);
}

}  // namespace
}  // namespace qwsm::test
