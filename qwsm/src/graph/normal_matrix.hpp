// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "qwsm/graph/pose_graph.hpp"

namespace qwsm {

/// The normal equations H d = -g of a graph: three rows per node but the first, which is fixed.
/// Which blocks of H there are follows from the edges and is found out once.
class NormalMatrix {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower>;

  explicit NormalMatrix(const PoseGraph& graph);

  /// Sets H and g at the poses. @param weights by edge
  void Linearize(const PoseGraph& graph,
                 std::span<const Pose2> T_map_node,
                 std::span<const double> weights);
  /// Factorises H. @return whether every pose is determined.
  bool Factorize();
  /// The step of Gauss-Newton, of all nodes but the first. @pre Factorize() returned true.
  Eigen::VectorXd Step() const { return factor_.solve(-gradient_); }

  const Factor& factor() const { return factor_; }
  Eigen::Index rows() const { return hessian_.rows(); }
  /// First row of a node. @pre node > 0
  static Eigen::Index RowOf(NodeId node) { return 3 * (static_cast<Eigen::Index>(node) - 1); }

 private:
  void Add(NodeId row, NodeId column, const Eigen::Matrix3d& block);

  Sparse hessian_;  // Its lower triangle.
  Eigen::VectorXd gradient_;
  Factor factor_;
};

}  // namespace qwsm
