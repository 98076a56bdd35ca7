// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "qwsm/graph/pose_graph.hpp"

namespace qwsm {

/// The poses that agree best with the edges of a graph.
struct [[nodiscard]] GraphSolution {
  std::vector<Pose2> T_map_node;
  std::vector<double> weights;  ///< Weight of each edge: 1 where it is believed, 0 where not.
  int iterations = 0;
  bool is_converged = false;
};

/// Least squares over the poses of a graph. The first node stays where it is.
class GraphSolver {
 public:
  GraphSolver() = default;
  GraphSolver(const GraphSolver&) = delete;
  GraphSolver& operator=(const GraphSolver&) = delete;
  virtual ~GraphSolver() = default;

  /// The poses that agree best with the edges.
  /// @pre every node hangs on the first by edges that tell of all three degrees of freedom.
  virtual GraphSolution Solve(const PoseGraph& graph) const = 0;
};

struct SparseGraphSolverOptions {
  int max_iterations = 100;
  double translation_tolerance_m = 1e-5;
  double rotation_tolerance_rad = 1e-6;
  /// A loop with a larger chi-square is wrong: 99 % of right ones are below, for three degrees of
  /// freedom.
  double max_loop_chi2 = 11.34;
};

/// Gauss-Newton with a sparse Cholesky factorisation (Kuemmerle et al. 2011). Wrong loops lose
/// their weight by graduated non-convexity with the loss of Geman and McClure (Yang et al. 2020):
/// at first nearly all loops count, and from step to step those that disagree count less.
/// Deterministic. Complexity: near linear in nodes and edges where loops are few.
class SparseGraphSolver final : public GraphSolver {
 public:
  explicit SparseGraphSolver(const SparseGraphSolverOptions& options = {}) : options_(options) {}

  GraphSolution Solve(const PoseGraph& graph) const override;

 private:
  SparseGraphSolverOptions options_;
};

}  // namespace qwsm
