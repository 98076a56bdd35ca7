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
/// Which blocks of H there are follows from the edges and is found out once. Nodes stand in an
/// order that fills the factor in little: it is nodes that are ordered (Amestoy, Davis and Duff
/// 1996), a ninth of the work of ordering rows, and H needs no copy to be factorised.
class NormalMatrix {
 public:
  using Sparse = Eigen::SparseMatrix<double>;
  using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Upper, Eigen::NaturalOrdering<int>>;

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
  Eigen::Index RowOf(NodeId node) const { return 3 * place_of_node_[node - 1]; }

 private:
  // Adds to the block of two nodes, or to its transpose, whichever is in the upper triangle.
  void Add(NodeId row, NodeId column, const Eigen::Matrix3d& block);

  std::vector<Eigen::Index> place_of_node_;  // Without the first.
  Sparse hessian_;                           // Its upper triangle.
  Eigen::VectorXd gradient_;
  Factor factor_;
};

}  // namespace qwsm
