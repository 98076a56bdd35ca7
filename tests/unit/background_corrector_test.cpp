// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/background_corrector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
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

/// A team of which one robot drives, and the other one has told of a single scan. Looks are done at
/// once.
class TeamWithOneThatDrives : public testing::Test {
 protected:
  static constexpr std::size_t kRobots = 2;

  TeamWithOneThatDrives() {
    for (std::size_t robot = 0; robot < kRobots; ++robot) {
      ScanNode node = *NodeMaker().Take(answers_.steps[robot]);
      node.robot = robot;
      corrector_.Add(std::move(node));
    }
    nodes_.Follow(answers_.steps.front().map_relevant);
  }
  void Drive() { corrector_.Add(*nodes_.Take(answers_.steps[next_++])); }
  void Stand() {
    corrector_.Add({.scan = answers_.steps[next_ - 1].relevant_scan,
                    .map_robot = *nodes_.map_last(),
                    .odometry = UncertainPose2::WithSigmas({}, 0.01, 0.003),
                    .T_last_node = Pose2{}});
  }
  Pose2 LastAnswered() const { return nodes_.map_last()->T_a_b; }
  /// Drives until a look has found something.
  void DriveUntilFound() {
    while (next_ < answers_.steps.size()) {
      Drive();
      if (!corrector_.IsLookDue()) continue;
      EXPECT_FALSE(corrector_.LookAgain());
      if (corrector_.IsLookDue()) return;
    }
    FAIL() << "nothing was found";
  }

  const Answers answers_ = BentOfficeLoop();
  BackgroundCorrector corrector_;
  NodeMaker nodes_;
  std::size_t next_ = 1;
};

TEST_F(TeamWithOneThatDrives, TakesUpWhatWasFoundWithTheNextScan) {
  DriveUntilFound();
  Stand();
  ASSERT_TRUE(corrector_.IsLookDue());
  const std::optional<CorrectedMap> corrected = corrector_.LookAgain();
  ASSERT_TRUE(corrected);
  EXPECT_EQ(corrected->map_node.size(), corrector_.size());
}

TEST_F(TeamWithOneThatDrives, PlacesBesideWhatTakesLong) {
  DriveUntilFound();
  const std::size_t looked_at = corrector_.size();
  for (std::size_t i = 0; i < 2 * kSinceLook; ++i) Stand();
  EXPECT_FALSE(corrector_.LookAgain());
  for (std::size_t i = 0; i < kSinceLook; ++i) Stand();
  const std::optional<CorrectedMap> corrected = corrector_.LookAgain();
  ASSERT_TRUE(corrected);
  ASSERT_EQ(corrected->map_node.size(), looked_at + 3 * kSinceLook);
  EXPECT_EQ(corrected->map.scans().size(), corrected->map_node.size());
  const Pose2 T_map_last = corrected->map_node[looked_at - 1].T_a_b;
  EXPECT_GT((T_map_last.Inverse() * LastAnswered()).translation_m().norm(), 0.1);
  for (const UncertainPose2& standing : std::span(corrected->map_node).subspan(looked_at)) {
    EXPECT_LT((T_map_last.Inverse() * standing.T_a_b).translation_m().norm(), 0.02);
  }
}

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
