// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/joint_correction.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/support/bent_drive.hpp"

namespace qwsm::test {
namespace {

ScanMap MapOfRelevant(const std::vector<MappingStep>& relevant) {
  ScanMap map;
  for (const MappingStep& step : relevant) {
    map.Insert(step.relevant_scan, ToPoints(step.relevant_scan), step.map_relevant);
  }
  return map;
}

// Of the first drive nothing is known but the map; the second one comes back to where it began.
TEST(JointCorrection, MendsAMapThatAnotherDriveWentOnWith) {
  Answers all = Drive(OfficeLoop());
  Bend(all.steps, 0.0003);
  const Answers relevant = Relevant(all);
  const ScanMap map = MapOfRelevant(relevant.steps);
  const std::size_t half = map.scans().size() / 2;
  Answers second;
  std::vector<StampedAnswer> answers;
  for (std::size_t i = 0; i < all.steps.size(); ++i) {
    if (all.steps[i].stamp < map.scans()[half].scan.stamp) continue;
    answers.push_back({.stamp = all.steps[i].stamp, .map_robot = all.steps[i].map_robot});
    second.T_map_true.push_back(all.T_map_true[i]);
  }

  const JointCorrection joint =
      CorrectJointly(map, std::vector{DriveInMap{.first_scan = half, .answers = answers}});
  const double before_m = WorstError_m(PathOf(relevant.steps), relevant.T_map_true);
  ASSERT_GT(before_m, 0.5);
  EXPECT_LT(WorstError_m(joint.correction.map_node, relevant.T_map_true), 0.2 * before_m);
  ASSERT_EQ(joint.map_robot.size(), 1U);
  ASSERT_EQ(joint.map_robot.front().size(), answers.size());
  EXPECT_LT(WorstError_m(joint.map_robot.front(), second.T_map_true), 0.2 * before_m);
  ASSERT_EQ(joint.scans.size(), map.scans().size());
  EXPECT_EQ(joint.scans.back().map_robot.T_a_b, joint.correction.map_node.back().T_a_b);
  const auto accepted =
      std::ranges::count(joint.correction.loops, LoopVerdict::kAccepted, &Loop::verdict);
  EXPECT_GT(accepted, 3);
}

// Neither of them closes the loop alone.
TEST(JointCorrection, CorrectsThePathsOfAllDrives) {
  Answers all = Drive(OfficeLoop());
  Bend(all.steps, 0.0003);
  const ScanMap map = MapOfRelevant(Relevant(all).steps);
  const std::size_t half = map.scans().size() / 2;
  std::array<Answers, 2> parts;
  std::array<std::vector<StampedAnswer>, 2> answers;
  for (std::size_t i = 0; i < all.steps.size(); ++i) {
    const std::size_t part = all.steps[i].stamp < map.scans()[half].scan.stamp ? 0 : 1;
    parts[part].steps.push_back(all.steps[i]);
    parts[part].T_map_true.push_back(all.T_map_true[i]);
    answers[part].push_back({.stamp = all.steps[i].stamp, .map_robot = all.steps[i].map_robot});
  }

  const JointCorrection joint =
      CorrectJointly(map,
                     std::vector<DriveInMap>{{.first_scan = 0, .answers = answers[0]},
                                             {.first_scan = half, .answers = answers[1]}});
  ASSERT_EQ(joint.map_robot.size(), parts.size());
  for (std::size_t part = 0; part < parts.size(); ++part) {
    SCOPED_TRACE(part);
    ASSERT_EQ(joint.map_robot[part].size(), answers[part].size());
    const double before_m = WorstError_m(PathOf(parts[part].steps), parts[part].T_map_true);
    EXPECT_LT(WorstError_m(joint.map_robot[part], parts[part].T_map_true), 0.3 * before_m);
  }
}

TEST(JointCorrection, LeavesAMapToWhichNothingWasAdded) {
  const Answers relevant = BentOfficeLoop();
  const ScanMap map = MapOfRelevant(relevant.steps);
  const std::vector<StampedAnswer> answers{{.stamp = {}, .map_robot = {.T_a_b = {1.0, 2.0, 0.5}}}};
  const JointCorrection joint = CorrectJointly(
      map, std::vector<DriveInMap>{{.first_scan = map.scans().size(), .answers = answers}});
  EXPECT_TRUE(joint.correction.loops.empty());
  ASSERT_EQ(joint.map_robot.front().size(), 1U);
  EXPECT_EQ(joint.map_robot.front().front().T_a_b, answers.front().map_robot.T_a_b);
  ASSERT_EQ(joint.scans.size(), map.scans().size());
  EXPECT_EQ(joint.scans.back().map_robot.T_a_b, map.scans().back().map_robot.T_a_b);
}

}  // namespace
}  // namespace qwsm::test
