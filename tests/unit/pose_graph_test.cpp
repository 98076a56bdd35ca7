// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "qwsm/graph/graph_covariance.hpp"
#include "qwsm/graph/graph_solver.hpp"

namespace qwsm {
namespace {

constexpr double kRelationSigma_m = 0.02;
constexpr double kRelationSigma_rad = 0.005;

Eigen::Matrix3d Information(double scale = 1.0) {
  const Eigen::Vector3d sigmas(kRelationSigma_m, 1.5 * kRelationSigma_m, kRelationSigma_rad);
  return (scale * sigmas).cwiseAbs2().cwiseInverse().asDiagonal();
}

// Twice around a square of ten metres, a node every metre, with loops to the first round.
struct TwoRounds {
  static constexpr NodeId kRound = 40;

  std::vector<Pose2> T_map_true;
  PoseGraph graph;
  std::mt19937 random{7};

  TwoRounds() {
    Pose2 pose;
    for (NodeId node = 0; node < 2 * kRound; ++node) {
      T_map_true.push_back(pose);
      pose =
          pose *
          Pose2{.x_m = 1.0, .y_m = 0.0, .theta_rad = node % 10 == 9 ? std::numbers::pi / 2 : 0.0};
    }
    graph.T_map_node.push_back(T_map_true.front());
    for (NodeId node = 1; node < 2 * kRound; ++node) {
      graph.edges.push_back(Measured(node - 1, node, EdgeTrust::kBackbone));
      graph.T_map_node.push_back(graph.T_map_node.back() * graph.edges.back().T_from_to);
    }
  }

  PoseEdge Measured(NodeId from, NodeId to, EdgeTrust trust) {
    std::normal_distribution<double> noise;
    Pose2 T = T_map_true[from].Inverse() * T_map_true[to];
    T.x_m += kRelationSigma_m * noise(random);
    T.y_m += 1.5 * kRelationSigma_m * noise(random);
    T.theta_rad = NormalizeAngle(T.theta_rad + kRelationSigma_rad * noise(random));
    return {.from = from, .to = to, .T_from_to = T, .information = Information(), .trust = trust};
  }

  void CloseLoops() {
    for (NodeId node = kRound; node < 2 * kRound; node += 4) {
      graph.edges.push_back(Measured(node - kRound, node, EdgeTrust::kLoop));
    }
  }

  double WorstError_m(const std::vector<Pose2>& poses) const {
    double worst_m = 0.0;
    for (NodeId node = 0; node < poses.size(); ++node) {
      worst_m = std::max(worst_m,
                         (poses[node].translation_m() - T_map_true[node].translation_m()).norm());
    }
    return worst_m;
  }
};

TEST(PoseGraph, JacobiansAreTheNumericOnes) {
  const std::vector<Pose2> poses = {{.x_m = 1.0, .y_m = -2.0, .theta_rad = 0.7},
                                    {.x_m = 3.0, .y_m = 0.5, .theta_rad = -2.9}};
  const PoseEdge edge{.from = 0, .to = 1, .T_from_to = {.x_m = 2.5, .y_m = 0.4, .theta_rad = 2.6}};
  const EdgeLinearization linear = Linearize(edge, poses);
  constexpr double kStep = 1e-6;
  for (int node = 0; node < 2; ++node) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Pose2> moved = poses;
      double* const number[] = {&moved[node].x_m, &moved[node].y_m, &moved[node].theta_rad};
      *number[axis] += kStep;
      const Eigen::Vector3d numeric = (Linearize(edge, moved).error - linear.error) / kStep;
      const Eigen::Matrix3d& J = node == 0 ? linear.J_from : linear.J_to;
      EXPECT_LT((numeric - J.col(axis)).norm(), 1e-5) << "node " << node << ", axis " << axis;
    }
  }
}

TEST(SparseGraphSolver, LeavesAChainAsItIs) {
  const TwoRounds rounds;
  const GraphSolution solution = SparseGraphSolver().Solve(rounds.graph);
  EXPECT_TRUE(solution.is_converged);
  for (NodeId node = 0; node < rounds.graph.T_map_node.size(); ++node) {
    EXPECT_NEAR(solution.T_map_node[node].x_m, rounds.graph.T_map_node[node].x_m, 1e-6);
    EXPECT_NEAR(solution.T_map_node[node].y_m, rounds.graph.T_map_node[node].y_m, 1e-6);
  }
}

TEST(SparseGraphSolver, SpreadsTheErrorOfALoopOverItsEdges) {
  // Ten equal steps along a line, and a loop that says it is 0.11 m longer than they do.
  PoseGraph graph{.T_map_node = {Pose2{}}, .edges = {}};
  for (NodeId node = 1; node <= 10; ++node) {
    graph.edges.push_back(
        {.from = node - 1, .to = node, .T_from_to = {.x_m = 1.0}, .information = Information()});
    graph.T_map_node.push_back({.x_m = 1.0 * node});
  }
  graph.edges.push_back({.from = 0,
                         .to = 10,
                         .T_from_to = {.x_m = 10.11},
                         .information = Information(),
                         .trust = EdgeTrust::kBackbone});
  const GraphSolution solution = SparseGraphSolver().Solve(graph);
  for (NodeId node = 0; node <= 10; ++node) {
    EXPECT_NEAR(solution.T_map_node[node].x_m, 1.01 * node, 1e-6);
  }
}

TEST(SparseGraphSolver, ClosesLoops) {
  TwoRounds rounds;
  const double before_m = rounds.WorstError_m(rounds.graph.T_map_node);
  rounds.CloseLoops();
  const GraphSolution solution = SparseGraphSolver().Solve(rounds.graph);
  EXPECT_TRUE(solution.is_converged);
  EXPECT_LT(rounds.WorstError_m(solution.T_map_node), before_m);
}

TEST(SparseGraphSolver, GivesWrongLoopsNoWeight) {
  TwoRounds rounds;
  rounds.CloseLoops();
  const double right_m = rounds.WorstError_m(SparseGraphSolver().Solve(rounds.graph).T_map_node);
  const std::size_t right = rounds.graph.edges.size();
  std::uniform_int_distribution<NodeId> any(0, 2 * TwoRounds::kRound - 1);
  for (int i = 0; i < 40; ++i) {  // Four times as many as right ones.
    const NodeId from = any(rounds.random);
    const NodeId to = (from + 5 + any(rounds.random) % 30) % (2 * TwoRounds::kRound);
    rounds.graph.edges.push_back({.from = from,
                                  .to = to,
                                  .T_from_to = {.x_m = 0.3, .theta_rad = 1.0},
                                  .information = Information(),
                                  .trust = EdgeTrust::kLoop});
  }
  const GraphSolution solution = SparseGraphSolver().Solve(rounds.graph);
  EXPECT_LT(rounds.WorstError_m(solution.T_map_node), 1.1 * right_m);
  for (std::size_t i = right; i < solution.weights.size(); ++i) {
    EXPECT_LT(solution.weights[i], 0.1) << "wrong loop " << i;
  }
}

TEST(SparseGraphSolver, TellsWhenANodeHangsOnNothing) {
  PoseGraph graph{.T_map_node = std::vector<Pose2>(3), .edges = {}};
  graph.edges.push_back({.from = 0, .to = 1, .T_from_to = {}, .information = Information()});
  EXPECT_FALSE(SparseGraphSolver().Solve(graph).is_converged);
}

TEST(SparseGraphSolver, SolvesAGraphOfOneNode) {
  EXPECT_TRUE(
      SparseGraphSolver().Solve({.T_map_node = {Pose2{.x_m = 3.0}}, .edges = {}}).is_converged);
}

TEST(GraphCovariance, IsTheInverseOfTheInformation) {
  TwoRounds rounds;
  rounds.CloseLoops();
  const GraphSolution solution = SparseGraphSolver().Solve(rounds.graph);
  const auto rows = 3 * static_cast<Eigen::Index>(solution.T_map_node.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, rows);
  for (std::size_t i = 0; i < rounds.graph.edges.size(); ++i) {
    const PoseEdge& edge = rounds.graph.edges[i];
    const EdgeLinearization linear = Linearize(edge, solution.T_map_node);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, rows);
    J.middleCols<3>(3 * edge.from) = linear.J_from;
    J.middleCols<3>(3 * edge.to) = linear.J_to;
    H += solution.weights[i] * J.transpose() * edge.information * J;
  }
  const Eigen::MatrixXd dense = H.bottomRightCorner(rows - 3, rows - 3).inverse();

  const GraphCovariance covariance(rounds.graph, solution);
  const auto marginals = covariance.Marginals();
  constexpr NodeId kFrom = 17;
  std::vector<NodeId> nodes(marginals.size());
  std::iota(nodes.begin(), nodes.end(), NodeId{0});
  const auto relative = covariance.RelativeTo(kFrom, nodes, marginals);
  for (NodeId node = 1; node < marginals.size(); ++node) {
    SCOPED_TRACE(node);
    const Eigen::Index row = 3 * (node - 1);
    EXPECT_LT((marginals[node] - dense.block<3, 3>(row, row)).norm(), 1e-9);
    if (node == kFrom) continue;
    const EdgeLinearization linear =
        Linearize({.from = kFrom, .to = node, .T_from_to = {}}, solution.T_map_node);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, rows - 3);
    J.middleCols<3>(3 * (kFrom - 1)) = linear.J_from;
    J.middleCols<3>(row) = linear.J_to;
    EXPECT_LT((relative[node] - J * dense * J.transpose()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace qwsm
