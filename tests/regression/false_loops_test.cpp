// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Loops that are wrong, among those of a whole drive, do not bend its map.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "qwsm/correction/map_corrector.hpp"
#include "qwsm/correction/node_maker.hpp"
#include "qwsm/graph/graph_solver.hpp"
#include "tests/support/bent_drive.hpp"

namespace qwsm::test {
namespace {

/// The graph of a drive whose map drifted by more than half a metre, its nodes as answered.
class FalseLoops : public ::testing::TestWithParam<double> {
 protected:
  void SetUp() override {
    NodeMaker nodes;
    MapCorrector corrector;
    for (const MappingStep& step : answers_.steps) {
      if (auto node = nodes.Take(step)) corrector.Add(std::move(*node));
    }
    graph_ = corrector.Correct().graph;
    for (std::size_t i = 0; i < answers_.steps.size(); ++i) {
      graph_.T_map_node[i] = answers_.steps[i].map_robot.T_a_b;
    }
  }

  std::size_t CountLoops() const {
    std::size_t loops = 0;
    for (const PoseEdge& edge : graph_.edges) loops += edge.trust == EdgeTrust::kLoop ? 1 : 0;
    return loops;
  }

  /// As certain as the right ones, between any two scans, to anywhere near.
  void AddFalse(std::size_t count, std::mt19937& random) {
    const PoseEdge like = graph_.edges.back();
    const std::size_t nodes = graph_.T_map_node.size();
    std::uniform_real_distribution<double> metres(-4.0, 4.0);
    std::uniform_real_distribution<double> radians(-3.0, 3.0);
    for (std::size_t i = 0; i < count; ++i) {
      PoseEdge wrong = like;
      wrong.from = static_cast<NodeId>(random() % (nodes - 1));
      wrong.to = static_cast<NodeId>(wrong.from + 1 + random() % (nodes - 1 - wrong.from));
      wrong.T_from_to = {
          .x_m = metres(random), .y_m = metres(random), .theta_rad = radians(random)};
      graph_.edges.push_back(wrong);
    }
  }

  double Error_m() const {
    const GraphSolution solution = SparseGraphSolver().Solve(graph_);
    double sum_m2 = 0.0;
    for (std::size_t i = 0; i < solution.T_map_node.size(); ++i) {
      const Eigen::Vector2d error_m =
          solution.T_map_node[i].translation_m() - answers_.T_map_true[i].translation_m();
      sum_m2 += error_m.squaredNorm();
    }
    return std::sqrt(sum_m2 / static_cast<double>(solution.T_map_node.size()));
  }

  const Answers answers_ = BentOfficeLoop();
  PoseGraph graph_;
};

TEST_P(FalseLoops, CostLessThanATenthOfTheError) {
  const double share = GetParam();
  const std::size_t right = CountLoops();
  ASSERT_GT(right, 3U);
  const double error_m = Error_m();
  const auto wrong = static_cast<std::size_t>(static_cast<double>(right) * share / (1.0 - share));
  const PoseGraph without = graph_;
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    graph_ = without;
    AddFalse(wrong, random);
    EXPECT_LT(Error_m(), 1.1 * error_m);
  }
}

INSTANTIATE_TEST_SUITE_P(Shares, FalseLoops, ::testing::Values(0.5, 0.8));

}  // namespace
}  // namespace qwsm::test
