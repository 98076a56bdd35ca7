// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/graph/graph_solver.hpp"

#include <algorithm>
#include <cmath>

#include "normal_matrix.hpp"

namespace qwsm {
namespace {

// By how much the loss becomes less convex from one step to the next (Yang et al. 2020).
constexpr double kLessConvex = 1.4;

void Move(const NormalMatrix& equations,
          const Eigen::VectorXd& step,
          std::vector<Pose2>& T_map_node) {
  for (NodeId node = 1; node < T_map_node.size(); ++node) {
    T_map_node[node] = Shifted(T_map_node[node], step.segment<3>(equations.RowOf(node)));
  }
}

bool IsWithinTolerance(const Eigen::VectorXd& step, const SparseGraphSolverOptions& options) {
  const auto of_nodes = step.reshaped(3, step.size() / 3);
  return of_nodes.topRows<2>().lpNorm<Eigen::Infinity>() < options.translation_tolerance_m &&
         of_nodes.bottomRows<1>().lpNorm<Eigen::Infinity>() < options.rotation_tolerance_rad;
}

// How convex the loss of loops has to be so that the worst one still counts; 1 is the loss itself.
// Yang et al. (2020) begin with it.
double InitialConvexity(const PoseGraph& graph, double max_loop_chi2) {
  double worst = 0.0;
  for (const PoseEdge& edge : graph.edges) {
    if (edge.trust == EdgeTrust::kLoop) worst = std::max(worst, Chi2(edge, graph.T_map_node));
  }
  return std::max(1.0, 2.0 * worst / max_loop_chi2);
}

// Yang et al. (2020), Eq. (12): weights of the surrogate of Geman and McClure's loss.
void WeighLoops(const PoseGraph& graph,
                double convexity,
                double max_loop_chi2,
                GraphSolution& solution) {
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (graph.edges[i].trust != EdgeTrust::kLoop) continue;
    const double scale = convexity * max_loop_chi2;
    const double root = scale / (Chi2(graph.edges[i], solution.T_map_node) + scale);
    solution.weights[i] = root * root;
  }
}

}  // namespace

GraphSolution SparseGraphSolver::Solve(const PoseGraph& graph) const {
  GraphSolution solution{.T_map_node = graph.T_map_node,
                         .weights = std::vector<double>(graph.edges.size(), 1.0)};
  NormalMatrix equations(graph);
  double convexity = InitialConvexity(graph, options_.max_loop_chi2);
  while (!solution.is_converged && solution.iterations < options_.max_iterations) {
    ++solution.iterations;
    WeighLoops(graph, convexity, options_.max_loop_chi2, solution);
    equations.Linearize(graph, solution.T_map_node, solution.weights);
    if (!equations.Factorize()) return solution;
    const Eigen::VectorXd step = equations.Step();
    Move(equations, step, solution.T_map_node);
    solution.is_converged = convexity == 1.0 && IsWithinTolerance(step, options_);
    convexity = std::max(1.0, convexity / kLessConvex);
  }
  return solution;
}

}  // namespace qwsm
