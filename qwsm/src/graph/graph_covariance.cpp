// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/graph/graph_covariance.hpp"

#include <algorithm>
#include <cassert>

#include "normal_matrix.hpp"

namespace qwsm {
namespace {

using Sparse = NormalMatrix::Sparse;

// An entry of a symmetric matrix that is kept as a lower triangle. @pre it is in the pattern
double StoredEntry(const Sparse& lower, Eigen::Index row, Eigen::Index column) {
  if (row < column) std::swap(row, column);
  const auto* const begin = lower.innerIndexPtr();
  const auto* const entry = std::lower_bound(
      begin + lower.outerIndexPtr()[column], begin + lower.outerIndexPtr()[column + 1], row);
  return lower.valuePtr()[entry - begin];
}

// The entries of (L D L^T)^-1 within the pattern of L, with its diagonal: Takahashi, Fagan & Chen
// (1973), Z = D^-1 L^-1 + (I - L^T) Z, from the last column to the first.
Sparse InverseOnPattern(const Sparse& L, const Eigen::VectorXd& D) {
  Sparse identity(L.rows(), L.cols());
  identity.setIdentity();
  Sparse Z = L.triangularView<Eigen::StrictlyLower>();
  Z = Z + identity;
  Sparse factor = Z;
  for (Eigen::Index j = L.cols() - 1; j >= 0; --j) {
    const Eigen::Index first = Z.outerIndexPtr()[j];
    const Eigen::Index end = Z.outerIndexPtr()[j + 1];
    for (Eigen::Index entry = end - 1; entry >= first; --entry) {
      const Eigen::Index i = Z.innerIndexPtr()[entry];
      double sum = i == j ? 1.0 / D(j) : 0.0;
      for (Eigen::Index k = first + 1; k < end; ++k) {
        sum -= factor.valuePtr()[k] * StoredEntry(Z, i, Z.innerIndexPtr()[k]);
      }
      Z.valuePtr()[entry] = sum;
    }
  }
  return Z;
}

}  // namespace

struct GraphCovariance::Factor {
  explicit Factor(const PoseGraph& graph) : equations(graph) {}

  NormalMatrix equations;

  // Three columns of the inverse, those of a node.
  Eigen::MatrixXd ColumnsOf(NodeId node) const {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(equations.rows(), 3);
    if (node > 0) unit.middleRows<3>(NormalMatrix::RowOf(node)).setIdentity();
    return equations.factor().solve(unit);
  }
};

GraphCovariance::GraphCovariance(const PoseGraph& graph, const GraphSolution& solution)
    : T_map_node_(solution.T_map_node), factor_(std::make_unique<Factor>(graph)) {
  factor_->equations.Linearize(graph, solution.T_map_node, solution.weights);
  [[maybe_unused]] const bool is_determined = factor_->equations.Factorize();
  assert(is_determined && "every node hangs on the first");
}

GraphCovariance::~GraphCovariance() = default;
GraphCovariance::GraphCovariance(GraphCovariance&&) noexcept = default;
GraphCovariance& GraphCovariance::operator=(GraphCovariance&&) noexcept = default;

std::vector<Eigen::Matrix3d> GraphCovariance::Marginals() const {
  const NormalMatrix::Factor& factor = factor_->equations.factor();
  const Sparse Z = InverseOnPattern(factor.matrixL().nestedExpression(), factor.vectorD());
  const auto& order = factor.permutationP().indices();
  std::vector<Eigen::Matrix3d> marginals(T_map_node_.size(), Eigen::Matrix3d::Zero());
  for (NodeId node = 1; node < T_map_node_.size(); ++node) {
    const Eigen::Index row = NormalMatrix::RowOf(node);
    for (Eigen::Index r = 0; r < 3; ++r) {
      for (Eigen::Index c = 0; c < 3; ++c) {
        marginals[node](r, c) = StoredEntry(Z, order(row + r), order(row + c));
      }
    }
  }
  return marginals;
}

std::vector<Eigen::Matrix3d> GraphCovariance::RelativeTo(
    NodeId from, const std::vector<Eigen::Matrix3d>& marginals) const {
  const Eigen::MatrixXd columns = factor_->ColumnsOf(from);
  std::vector<Eigen::Matrix3d> relative(T_map_node_.size(), Eigen::Matrix3d::Zero());
  for (NodeId node = 0; node < T_map_node_.size(); ++node) {
    if (node == from) continue;
    const EdgeLinearization linear =
        Linearize({.from = from, .to = node, .T_from_to = {}}, T_map_node_);
    const Eigen::Matrix3d cross = node > 0 ? columns.middleRows<3>(NormalMatrix::RowOf(node)).eval()
                                           : Eigen::Matrix3d::Zero();
    const Eigen::Matrix3d mixed = linear.J_to * cross * linear.J_from.transpose();
    relative[node] = linear.J_from * marginals[from] * linear.J_from.transpose() +
                     linear.J_to * marginals[node] * linear.J_to.transpose() + mixed +
                     mixed.transpose();
  }
  return relative;
}

}  // namespace qwsm
