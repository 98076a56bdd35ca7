// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/background_corrector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "qwsm/correction/node_maker.hpp"
#include "tests/support/bent_drive.hpp"

namespace qwsm::test {
namespace {

// So many come between two looks.
constexpr std::size_t kSinceLook = 8;

/// The map as it is corrected first, if it ever is.
std::optional<CorrectedMap> FirstCorrection(std::span<const MappingStep> steps) {
  BackgroundCorrector corrector({}, WorkAtOnce, ChainsOf::kOneRobot);
  NodeMaker nodes;
  for (const MappingStep& step : steps) {
    corrector.Add(*nodes.Take(step));
    if (!corrector.IsLookDue()) continue;
    if (auto corrected = corrector.LookAgain()) return corrected;
  }
  return std::nullopt;
}

/// As if the answers had come from where the map has drifted to where it has not, within so many:
/// they slide there, or leap.
void CallBack(std::span<MappingStep> steps, const Pose2& T_map_true_last, std::size_t within) {
  const Eigen::Vector3d way = Difference(T_map_true_last, steps.back().map_robot.T_a_b);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double share = static_cast<double>(std::min(i + 1, within)) / static_cast<double>(within);
    steps[i].map_robot.T_a_b = Shifted(steps[i].map_robot.T_a_b, share * way);
    steps[i].map_relevant = steps[i].map_robot;
  }
}

class BackgroundCorrectorCalledBack : public testing::TestWithParam<std::size_t> {};

// The robot has not driven there.
TEST_P(BackgroundCorrectorCalledBack, PlacesAnewWhatCameMeanwhile) {
  Answers answers = BentOfficeLoop();
  const std::optional<CorrectedMap> before = FirstCorrection(answers.steps);
  ASSERT_TRUE(before);
  const std::size_t nodes = before->map_node.size();
  answers.steps.resize(nodes);
  answers.T_map_true.resize(nodes);
  const double drift_m = WorstError_m(PathOf(answers.steps), answers.T_map_true);
  ASSERT_GT(drift_m, 0.5);

  CallBack(std::span(answers.steps).last(kSinceLook), answers.T_map_true.back(), GetParam());
  const std::optional<CorrectedMap> corrected = FirstCorrection(answers.steps);
  ASSERT_TRUE(corrected);
  ASSERT_EQ(corrected->map_node.size(), nodes);
  EXPECT_LT(WorstError_m(corrected->map_node, answers.T_map_true), 0.1 * drift_m);
}

INSTANTIATE_TEST_SUITE_P(, BackgroundCorrectorCalledBack, testing::Values(kSinceLook, 1));

TEST(BackgroundCorrector, KeepsItsScansOverACorrection) {
  const Answers answers = BentOfficeLoop();
  BackgroundCorrector corrector({}, WorkAtOnce, ChainsOf::kOneRobot);
  NodeMaker nodes;
  for (std::size_t i = 0; i < kSinceLook; ++i) corrector.Add(*nodes.Take(answers.steps[i]));
  EXPECT_EQ(corrector.Correct().map_node.size(), kSinceLook);
  EXPECT_EQ(corrector.size(), kSinceLook);
  corrector.ForgetSince(kSinceLook - 1);
  EXPECT_EQ(corrector.Correct().map_node.size(), kSinceLook - 1);
}

}  // namespace
}  // namespace qwsm::test
