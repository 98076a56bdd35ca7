// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "qwsm/graph/graph_covariance.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "normal_matrix.hpp"

namespace qwsm {
namespace {

using Sparse = NormalMatrix::Sparse;

// The entries of (L D L^T)^-1 on the diagonal and within the pattern of L: Takahashi, Fagan & Chen
// (1973), Z = D^-1 L^-1 + (I - L^T) Z, from the last column to the first. Each column of Z takes
// the place of that of L, which no other column needs.
class InverseOnPattern {
 public:
  InverseOnPattern(const Sparse& L, const Eigen::VectorXd& D)
      : diagonal_(D.cwiseInverse()), below_(L.triangularView<Eigen::StrictlyLower>()) {
    for (Eigen::Index j = L.cols() - 1; j >= 0; --j) SolveColumn(j);
  }

  // @pre the entry is in the pattern
  double At(Eigen::Index row, Eigen::Index column) const {
    if (row == column) return diagonal_(row);
    const auto [first, last] = std::minmax(row, column);
    const auto* const begin = below_.innerIndexPtr();
    const auto* const entry = std::lower_bound(
        begin + below_.outerIndexPtr()[first], begin + below_.outerIndexPtr()[first + 1], last);
    return below_.valuePtr()[entry - begin];
  }

 private:
  void SolveColumn(Eigen::Index j) {
    const Eigen::Index first = below_.outerIndexPtr()[j];
    const Eigen::Index end = below_.outerIndexPtr()[j + 1];
    const std::vector<double> of_L(below_.valuePtr() + first, below_.valuePtr() + end);
    const auto sum_of_row = [&](Eigen::Index i, double sum) {
      for (Eigen::Index k = first; k < end; ++k) {
        sum -= of_L[static_cast<std::size_t>(k - first)] * At(i, below_.innerIndexPtr()[k]);
      }
      return sum;
    };
    for (Eigen::Index entry = end - 1; entry >= first; --entry) {
      below_.valuePtr()[entry] = sum_of_row(below_.innerIndexPtr()[entry], 0.0);
    }
    diagonal_(j) = sum_of_row(j, diagonal_(j));
  }

  Eigen::VectorXd diagonal_;
  Sparse below_;
};

}  // namespace

struct GraphCovariance::Factor {
  explicit Factor(const PoseGraph& graph) : equations(graph) {}

  NormalMatrix equations;

  // Three columns of the inverse, those of a node.
  Eigen::MatrixXd ColumnsOf(NodeId node) const {
    Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(equations.rows(), 3);
    if (node > 0) unit.middleRows<3>(equations.RowOf(node)).setIdentity();
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
  const NormalMatrix& equations = factor_->equations;
  const NormalMatrix::Factor& factor = equations.factor();
  const InverseOnPattern Z(factor.matrixL().nestedExpression(), factor.vectorD());
  std::vector<Eigen::Matrix3d> marginals(T_map_node_.size(), Eigen::Matrix3d::Zero());
  for (NodeId node = 1; node < T_map_node_.size(); ++node) {
    const Eigen::Index row = equations.RowOf(node);
    for (Eigen::Index r = 0; r < 3; ++r) {
      for (Eigen::Index c = 0; c < 3; ++c) marginals[node](r, c) = Z.At(row + r, row + c);
    }
  }
  return marginals;
}

std::vector<Eigen::Matrix3d> GraphCovariance::RelativeTo(
    NodeId from,
    std::span<const NodeId> nodes,
    const std::vector<Eigen::Matrix3d>& marginals) const {
  const Eigen::MatrixXd columns = factor_->ColumnsOf(from);
  std::vector<Eigen::Matrix3d> relative(nodes.size(), Eigen::Matrix3d::Zero());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeId node = nodes[i];
    if (node == from) continue;
    const EdgeLinearization linear =
        Linearize({.from = from, .to = node, .T_from_to = {}}, T_map_node_);
    const Eigen::Matrix3d cross = node > 0
                                      ? columns.middleRows<3>(factor_->equations.RowOf(node)).eval()
                                      : Eigen::Matrix3d::Zero();
    const Eigen::Matrix3d mixed = linear.J_to * cross * linear.J_from.transpose();
    relative[i] = linear.J_from * marginals[from] * linear.J_from.transpose() +
                  linear.J_to * marginals[node] * linear.J_to.transpose() + mixed +
                  mixed.transpose();
  }
  return relative;
}

}  // namespace qwsm
