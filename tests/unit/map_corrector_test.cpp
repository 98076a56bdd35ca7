// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/correction/map_corrector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "qwsm/correction/node_maker.hpp"
#include "tests/support/bent_drive.hpp"

namespace qwsm::test {
namespace {

MapCorrector Fed(const std::vector<MappingStep>& steps) {
  MapCorrector corrector;
  NodeMaker nodes;
  for (const MappingStep& step : steps) {
    if (auto node = nodes.Take(step)) corrector.Add(std::move(*node));
  }
  return corrector;
}

Correction Corrected(const std::vector<MappingStep>& steps) { return Fed(steps).Correct(); }

TEST(MapCorrector, MendsThePathOnceTheRobotIsBack) {
  Answers answers = Drive(OfficeLoop());
  Bend(answers.steps, 0.0003);
  const Answers relevant = Relevant(answers);
  const double before_m = WorstError_m(PathOf(relevant.steps), relevant.T_map_true);
  ASSERT_GT(before_m, 0.5);
  const Correction correction = Corrected(answers.steps);
  ASSERT_EQ(correction.map_node.size(), relevant.steps.size());
  EXPECT_GT(std::ranges::count(correction.loops, LoopVerdict::kAccepted, &Loop::verdict), 3);
  EXPECT_LT(WorstError_m(correction.map_node, relevant.T_map_true), 0.2 * before_m);
}

// The map begins with the first scan, and the next ones fit it.
TEST(MapCorrector, KnowsTheNextScansAsWellAsTheyFitTheFirst) {
  Answers answers = Drive(OfficeLoop());
  Bend(answers.steps, 0.0003);
  const Correction correction = Corrected(answers.steps);
  ASSERT_GT(std::ranges::count(correction.loops, LoopVerdict::kAccepted, &Loop::verdict), 0);
  EXPECT_TRUE(correction.map_node.front().covariance.isZero());
  for (const UncertainPose2& next : std::span(correction.map_node).subspan(1, 3)) {
    EXPECT_LT(next.SigmaXY_m(), 0.012);
    EXPECT_LT(next.SigmaTheta_rad(), 0.003);
  }
}

// Two halves of a drive, as if two robots had taken turns.
TEST(MapCorrector, KeepsTheScansOfEachRobotInAChainOfItsOwn) {
  Answers answers = Drive(OfficeLoop());
  Bend(answers.steps, 0.0003);
  const Answers relevant = Relevant(answers);
  const std::size_t half = relevant.steps.size() / 2;
  MapCorrector corrector;
  std::array<NodeMaker, 2> nodes;
  std::vector<Pose2> T_map_true;
  for (std::size_t i = 0; i < half; ++i) {
    for (std::size_t robot = 0; robot < 2; ++robot) {
      auto node = nodes[robot].Take(relevant.steps[robot * half + i]);
      node->robot = robot;
      corrector.Add(std::move(*node));
      T_map_true.push_back(relevant.T_map_true[robot * half + i]);
    }
  }
  const Correction correction = corrector.Correct();
  const double before_m = WorstError_m(PathOf(relevant.steps), relevant.T_map_true);
  EXPECT_LT(WorstError_m(correction.map_node, T_map_true), 0.2 * before_m);
}

// The nodes of two robots in turns, in one chain each.
std::vector<ScanNode> NodesOfTwo(const std::vector<MappingStep>& relevant) {
  const std::size_t half = relevant.size() / 2;
  std::array<NodeMaker, 2> makers;
  std::vector<ScanNode> nodes;
  for (std::size_t i = 0; i < half; ++i) {
    for (std::size_t robot = 0; robot < 2; ++robot) {
      nodes.push_back(*makers[robot].Take(relevant[robot * half + i]));
      nodes.back().robot = robot;
    }
  }
  return nodes;
}

void Add(std::span<const ScanNode> nodes, MapCorrector& corrector) {
  for (const ScanNode& node : nodes) corrector.Add(node);
}

TEST(MapCorrector, ForgetsNodesAsIfTheyHadNeverBeenAdded) {
  const std::vector<ScanNode> nodes = NodesOfTwo(BentOfficeLoop().steps);
  MapCorrector unbroken;
  Add(nodes, unbroken);
  const Correction expected = unbroken.Correct();
  const std::span<const ScanNode> all(nodes);
  for (const NodeId first : {NodeId{0}, NodeId{1}, NodeId{2}, NodeId{33}, NodeId{70}}) {
    SCOPED_TRACE(first);
    MapCorrector forgetful;
    Add(all.first(first), forgetful);
    Add(all.last(40), forgetful);  // From elsewhere: they fit nothing.
    forgetful.ForgetSince(first);
    Add(all.subspan(first), forgetful);
    const Correction correction = forgetful.Correct();
    ASSERT_EQ(correction.map_node.size(), expected.map_node.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      EXPECT_EQ(correction.map_node[i].T_a_b, expected.map_node[i].T_a_b) << i;
      EXPECT_EQ(correction.map_node[i].covariance, expected.map_node[i].covariance) << i;
    }
    EXPECT_EQ(correction.loops.size(), expected.loops.size());
  }
}

// Where nothing lies between a submap's reference and its last scan, its frame is certain.
TEST(MapCorrector, RecognisesARobotByWhatAnotherSawOfItsFirstScans) {
  Answers answers = Drive(OfficeLoop());
  const Answers relevant = Relevant(answers);
  for (std::size_t seen = 1; seen <= 2; ++seen) {
    MapCorrector corrector;
    std::array<NodeMaker, 2> nodes;
    for (std::size_t i = 0; i < seen; ++i) corrector.Add(*nodes[0].Take(relevant.steps[i]));
    for (const MappingStep& step : relevant.steps) {
      ScanNode node = *nodes[1].Take(step);
      node.robot = 1;
      corrector.Add(std::move(node));
    }
    std::size_t by_the_other = 0;
    for (const Loop& loop : corrector.Correct().loops) {
      EXPECT_TRUE(loop.edge.information.allFinite());
      if (loop.edge.from < seen && loop.verdict == LoopVerdict::kAccepted) ++by_the_other;
    }
    EXPECT_GT(by_the_other, 2U) << seen;
  }
}

// The part of the map where it is may be metres off: that says nothing of where the robot is there.
TEST(MapCorrector, HangsARobotThatWasFoundOnTheNodeBesideIt) {
  const Answers relevant = Relevant(Drive(OfficeLoop()));
  constexpr NodeId kBeside = 4;
  MapCorrector corrector;
  NodeMaker first;
  for (NodeId i = 0; i <= kBeside; ++i) corrector.Add(*first.Take(relevant.steps[i]));
  NodeMaker second;
  ScanNode found = *second.Take(relevant.steps[kBeside + 1]);
  const Pose2 T_beside_found{.x_m = 0.5, .y_m = -0.1, .theta_rad = 0.2};
  found.robot = 1;
  found.found = {kBeside, UncertainPose2::WithSigmas(T_beside_found, 0.03, 0.004)};
  found.map_robot = UncertainPose2::WithSigmas(found.map_robot.T_a_b, 2.0, 0.1);
  corrector.Add(std::move(found));
  const PoseGraph graph = corrector.Correct().graph;
  const auto entry = std::ranges::find(graph.edges, kBeside + 1, &PoseEdge::to);
  ASSERT_NE(entry, graph.edges.end());
  EXPECT_EQ(entry->from, kBeside);
  EXPECT_EQ(entry->T_from_to, T_beside_found);
  EXPECT_GT(entry->information(0, 0), 1.0 / (0.1 * 0.1));
}

TEST(MapCorrector, ProposesWhereTheMapContradictsItselfAndIsContentThen) {
  Answers answers = Drive(OfficeLoop());
  Bend(answers.steps, 0.0003);
  const Answers relevant = Relevant(answers);
  MapCorrector corrector = Fed(answers.steps);
  const auto proposed = corrector.Propose();
  ASSERT_TRUE(proposed);
  const double before_m = WorstError_m(PathOf(relevant.steps), relevant.T_map_true);
  EXPECT_LT(WorstError_m(*proposed, relevant.T_map_true), 0.5 * before_m);
  corrector.Adopt(*proposed);
  EXPECT_FALSE(corrector.Propose());
}

TEST(MapCorrector, ProposesNothingWhereTheMapIsRight) {
  EXPECT_FALSE(Fed(Drive(OfficeLoop()).steps).Propose());
}

TEST(MapCorrector, GivesTheSameTwice) {
  const Answers answers = Drive(OfficeLoop());
  const Correction once = Corrected(answers.steps);
  const Correction twice = Corrected(answers.steps);
  ASSERT_EQ(once.map_node.size(), twice.map_node.size());
  for (std::size_t i = 0; i < once.map_node.size(); ++i) {
    EXPECT_EQ(once.map_node[i].T_a_b, twice.map_node[i].T_a_b) << i;
  }
}

TEST(MapCorrector, LeavesAPathWithoutLoopsAsItWasAnswered) {
  Scene scene = OfficeLoop();
  scene.route_m.resize(2);
  const Answers answers = Drive(scene);
  const Correction correction = Corrected(answers.steps);
  EXPECT_TRUE(correction.loops.empty());
  const std::vector<MappingStep> relevant = Relevant(answers).steps;
  ASSERT_EQ(correction.map_node.size(), relevant.size());
  for (std::size_t i = 0; i < relevant.size(); ++i) {
    EXPECT_EQ(correction.map_node[i].T_a_b, relevant[i].map_robot.T_a_b) << i;
    EXPECT_EQ(correction.map_node[i].covariance, relevant[i].map_robot.covariance) << i;
  }
}

// The answers go on a third of a metre beside, the scans do not.
TEST(MapCorrector, MendsAStepThatWasAnsweredWrongly) {
  Answers answers = Drive(OfficeLoop());
  const std::size_t half_way = answers.steps.size() / 2;
  const Pose2 T_wrong = {.x_m = 0.3, .y_m = -0.2};
  for (std::size_t i = half_way; i < answers.steps.size(); ++i) {
    answers.steps[i].map_robot.T_a_b = T_wrong * answers.steps[i].map_robot.T_a_b;
    answers.steps[i].map_robot.covariance.diagonal() += Eigen::Vector3d(0.1, 0.1, 0.001);
    answers.steps[i].map_relevant = answers.steps[i].map_robot;
  }
  const Correction correction = Corrected(answers.steps);
  EXPECT_LT(WorstError_m({correction.map_node.back()}, {Relevant(answers).T_map_true.back()}), 0.1);
}

// Seen from all sides it looks the same: it tells where it stands, and not how the robot is turned.
TEST(MapCorrector, ClosesNoLoopAtASingleTree) {
  const auto loops_at = [](const std::vector<Column>& trees) {
    Answers answers = Drive({.world = {.walls = {}, .columns = trees},
                             .route_m = {{0.0, 0.0}, {20.0, 0.0}, {0.0, 0.3}, {20.0, 0.0}}},
                            5.0);
    for (std::size_t i = 0; i < answers.steps.size(); ++i) {
      MappingStep& step = answers.steps[i];
      step.map_robot = UncertainPose2::WithSigmas(answers.T_map_true[i], 0.5, 0.1);
      step.map_relevant = step.map_robot;
    }
    return Corrected(answers.steps).loops.size();
  };
  const Column tree{.center_m = {7.0, 2.0}, .radius_m = 0.25};
  const Column other{.center_m = {8.0, -1.8}, .radius_m = 0.5};
  EXPECT_EQ(loops_at({tree}), 0U);
  EXPECT_GT(loops_at({tree, other}), 0U);
}

// Wheels slip with one scan of a hundred: that nothing is seen is no sign that they did.
TEST(MapCorrector, GoesByOdometryWhereNothingIsSeen) {
  const Answers answers = Drive({.world = {.walls = {},
                                           .columns = {{.center_m = {3.0, 1.0}, .radius_m = 0.2},
                                                       {.center_m = {4.0, -1.5}, .radius_m = 0.2},
                                                       {.center_m = {19.0, 1.5}, .radius_m = 0.2}}},
                                 .route_m = {{0.0, 0.0}, {20.0, 0.0}}},
                                5.0);
  double most_m = 0.0;
  for (const PoseEdge& edge : Corrected(answers.steps).graph.edges) {
    most_m = std::max(most_m, MeasuredBy(edge).SigmaXY_m());
  }
  EXPECT_GT(most_m, 0.03);
  EXPECT_LT(most_m, 0.1);
}

TEST(MapCorrector, HasNothingToCorrectWithoutScans) {
  MapCorrector corrector;
  EXPECT_TRUE(corrector.Correct().map_node.empty());
  EXPECT_FALSE(corrector.Propose());
  EXPECT_TRUE(corrector.MapAt({}).empty());
}

TEST(MapCorrector, InsertsScansAnewWhereTheyBelong) {
  const std::vector<MappingStep> steps = Drive(FurnishedRoom()).steps;
  MapCorrector corrector = Fed(steps);
  std::vector<UncertainPose2> moved = corrector.Correct().map_node;
  const double x_m = moved.back().T_a_b.x_m;
  for (UncertainPose2& map_node : moved) map_node.T_a_b = Pose2{.x_m = 5.0} * map_node.T_a_b;
  const ScanMap elsewhere = corrector.MapAt(moved);
  ASSERT_EQ(elsewhere.scans().size(), moved.size());
  EXPECT_NEAR(elsewhere.scans().back().map_robot.T_a_b.x_m, x_m + 5.0, 1e-9);
}

}  // namespace
}  // namespace qwsm::test
