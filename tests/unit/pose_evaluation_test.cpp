// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "service/pipeline/slam6d/pose_evaluation.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace slam6d::pipeline {
namespace {

io::NumberedPoses Numbered(const std::vector<int>& numbers) {
  io::NumberedPoses poses;
  for (const int number : numbers) poses[number] = {};
  return poses;
}

PoseErrors OfNine(const std::vector<int>& numbers) {
  return Compare(Numbered(numbers), Numbered({0, 1, 2, 3, 4, 5, 6, 7, 8}), PoseAlignment::kFirst);
}

TEST(PoseEvaluation, TellsHowMuchOfTheTruthWasCompared) {
  EXPECT_EQ(OfNine({3}).poses, 1U);
  EXPECT_EQ(OfNine({3}).true_poses, 9U);
  EXPECT_EQ(OfNine({3}).covered, 0.0);
  EXPECT_EQ(OfNine({2, 4}).covered, 0.25);
  EXPECT_EQ(OfNine({0, 4, 8, 99}).covered, 1.0);
}

// As of scans named from 1 on, and poses of the lines of a file.
TEST(PoseEvaluation, PairsPosesThatAreOnlyCountedByTheirOrder) {
  EXPECT_EQ(Compare(Numbered({1, 2, 3}), Numbered({0, 1, 2}), PoseAlignment::kFirst).poses, 3U);
  EXPECT_EQ(Compare(Numbered({0, 1, 2}), Numbered({0, 3, 4}), PoseAlignment::kFirst).poses, 3U);
  EXPECT_EQ(Compare(Numbered({1, 2, 3}), Numbered({2, 3, 4}), PoseAlignment::kFirst).poses, 2U);
  EXPECT_EQ(OfNine({1, 2, 3}).poses, 3U);
}

// As of clouds of a bag, and of a camera system that looks at the robot a hundred times a second.
TEST(PoseEvaluation, PairsStampsThatAreNearEachOther) {
  constexpr double kBegin_s = 1305031102.0;
  const auto along_x = [](double number) { return Pose3{.translation_m = {number, 0.0, 0.0}}; };
  io::NumberedPoses truth;
  for (int i = 0; i < 1000; ++i) truth[kBegin_s + 0.01 * i] = along_x(0.01 * i);
  io::NumberedPoses estimate;
  for (int i = 0; i < 10; ++i) estimate[kBegin_s + i + 0.0031] = along_x(i);
  estimate[kBegin_s - 0.02] = along_x(99.0);
  estimate[kBegin_s + 10.1] = along_x(99.0);
  const PoseErrors errors = Compare(estimate, truth, PoseAlignment::kNone);
  EXPECT_EQ(errors.poses, 10U);
  EXPECT_EQ(errors.max_m, 0.0);
  EXPECT_NEAR(errors.covered, 0.9, 0.01);
}

TEST(PoseEvaluation, OfAFileWithoutPosesIsRefused) {
  const qwsm::test::TemporaryFolder folder;
  std::ofstream(folder.path() / "none.tum") << "# nothing\n";
  EXPECT_THROW(static_cast<void>(io::ReadPoses(folder.path() / "none.tum")), std::runtime_error);
}

}  // namespace
}  // namespace slam6d::pipeline
