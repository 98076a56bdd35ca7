// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slam6d/graph/ceres_loop_closer.hpp"
#include "slam6d/mapping/loop_hypotheses.hpp"
#include "slam6d/mapping/pose_graph.hpp"
#include "tests/support/room3.hpp"

namespace slam6d {
namespace {

struct Loop {
  std::vector<Pose3> truth;
  PoseGraph graph;
};

/// Poses on a circle, chained by constraints with errors, the last of which comes back to the
/// first.
Loop MakeLoop(unsigned seed) {
  constexpr std::size_t kScans = 20;
  std::mt19937 random(seed);
  Loop loop;
  for (std::size_t i = 0; i < kScans; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * static_cast<double>(i) / kScans;
    loop.truth.push_back(
        {.rotation = RotationFromRollPitchYaw({0.02, 0.0, angle_rad}),
         .translation_m = {5.0 * std::cos(angle_rad), 5.0 * std::sin(angle_rad), 0.3}});
  }
  loop.graph.T_map_scan = {loop.truth.front()};
  for (std::size_t i = 1; i < kScans; ++i) {
    Pose3 step = loop.truth[i - 1].Inverse() * loop.truth[i];
    step.translation_m += DrawNormal(random, 0.02);
    step.rotation = RotationFromVector(DrawNormal(random, 0.01)) * step.rotation;
    loop.graph.constraints.push_back(
        {.from = i - 1, .to = i, .T_from_to = step, .covariance = 1e-4 * Matrix6d::Identity()});
    loop.graph.T_map_scan.push_back(loop.graph.T_map_scan.back() * step);
  }
  loop.graph.constraints.push_back({.from = 0,
                                    .to = kScans - 1,
                                    .T_from_to = loop.truth.front().Inverse() * loop.truth.back(),
                                    .covariance = 1e-8 * Matrix6d::Identity()});
  return loop;
}

double LargestGapM(const std::vector<Pose3>& poses, const std::vector<Pose3>& truth) {
  double largest_m = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    largest_m = std::max(largest_m, (poses[i].translation_m - truth[i].translation_m).norm());
  }
  return largest_m;
}

TEST(LoopCloser, ClosesTheLoopAndLeavesTheFirstScan) {
  const PathLoopCloser path;
  const graph::CeresLoopCloser ceres;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Loop loop = MakeLoop(seed);
    const double open_m = LargestGapM(loop.graph.T_map_scan, loop.truth);
    for (const LoopCloser* closer :
         {static_cast<const LoopCloser*>(&path), static_cast<const LoopCloser*>(&ceres)}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << (closer == &path ? " path" : " Ceres"));
      const std::vector<Pose3> closed = closer->Close(loop.graph);
      EXPECT_LT((closed.back().translation_m - loop.truth.back().translation_m).norm(), 1e-3);
      EXPECT_LT(RotationAngle(closed.back().rotation.transpose() * loop.truth.back().rotation),
                1e-3);
      EXPECT_TRUE(closed.front().rotation.isApprox(loop.truth.front().rotation, 1e-12));
      EXPECT_EQ(closed.front().translation_m, loop.truth.front().translation_m);
      EXPECT_LT(LargestGapM(closed, loop.truth), open_m);
    }
  }
}

TEST(LoopCloser, LeavesALoopWithoutErrorAsItIs) {
  Loop loop = MakeLoop(9);
  loop.graph.T_map_scan = loop.truth;
  for (PoseConstraint& constraint : loop.graph.constraints) {
    constraint.T_from_to = loop.truth[constraint.from].Inverse() * loop.truth[constraint.to];
  }
  const PathLoopCloser path;
  const graph::CeresLoopCloser ceres;
  EXPECT_LT(LargestGapM(path.Close(loop.graph), loop.truth), 1e-9);
  EXPECT_LT(LargestGapM(ceres.Close(loop.graph), loop.truth), 1e-9);
}

TEST(PathLoopCloser, MovesWhatComesAfterTheLoopAsAWhole) {
  Loop loop = MakeLoop(3);
  const Pose3 T_last_next{.translation_m = {1.0, 2.0, 0.0}};
  loop.graph.T_map_scan.push_back(loop.graph.T_map_scan.back() * T_last_next);
  const std::vector<Pose3> closed = PathLoopCloser().Close(loop.graph);
  const Pose3 after = closed[closed.size() - 2].Inverse() * closed.back();
  EXPECT_LT((after.translation_m - T_last_next.translation_m).norm(), 1e-9);
}

TEST(LoopHypotheses, AreNearInSpaceAndFarInSequence) {
  std::vector<Pose3> poses;
  for (int i = 0; i < 20; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / 20.0;
    poses.push_back({.translation_m = {9.0 * std::cos(angle_rad), 9.0 * std::sin(angle_rad), 0.0}});
  }
  const LoopOptions options{.min_scans_between = 10, .max_hypotheses = 2};
  EXPECT_EQ(LoopHypotheses(poses, 20.0, options), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(LoopHypotheses(poses, 5.0, options).empty()) << "beyond half the scanner's range";
  EXPECT_TRUE(LoopHypotheses(poses, 20.0, {.enabled = false}).empty());
  EXPECT_TRUE(LoopHypotheses({poses.data(), 5}, 20.0, options).empty());
}

}  // namespace
}  // namespace slam6d
