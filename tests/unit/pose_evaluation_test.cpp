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

TEST(PoseEvaluation, OfAFileWithoutPosesIsRefused) {
  const qwsm::test::TemporaryFolder folder;
  std::ofstream(folder.path() / "none.tum") << "# nothing\n";
  EXPECT_THROW(static_cast<void>(io::ReadPoses(folder.path() / "none.tum")), std::runtime_error);
}

}  // namespace
}  // namespace slam6d::pipeline
