// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "normal_matrix.hpp"

#include <algorithm>

namespace qwsm {

NormalMatrix::NormalMatrix(const PoseGraph& graph) {
  const auto rows = RowOf(static_cast<NodeId>(graph.T_map_node.size()));
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_block = [&entries](NodeId row, NodeId column) {
    for (Eigen::Index c = 0; c < 3; ++c) {
      for (Eigen::Index r = row == column ? c : 0; r < 3; ++r) {
        entries.emplace_back(RowOf(row) + r, RowOf(column) + c, 0.0);
      }
    }
  };
  for (NodeId node = 1; node < graph.T_map_node.size(); ++node) add_block(node, node);
  for (const PoseEdge& edge : graph.edges) {
    const auto [column, row] = std::minmax(edge.from, edge.to);
    if (column > 0) add_block(row, column);
  }
  hessian_.resize(rows, rows);
  hessian_.setFromTriplets(entries.begin(), entries.end());
  gradient_.resize(rows);
  factor_.analyzePattern(hessian_);
}

void NormalMatrix::Add(NodeId row, NodeId column, const Eigen::Matrix3d& block) {
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::Index first = row == column ? c : 0;
    const auto* const begin = hessian_.innerIndexPtr();
    const Eigen::Index sparse_column = RowOf(column) + c;
    const auto* const entry = std::lower_bound(begin + hessian_.outerIndexPtr()[sparse_column],
                                               begin + hessian_.outerIndexPtr()[sparse_column + 1],
                                               RowOf(row) + first);
    double* value = hessian_.valuePtr() + (entry - begin);
    for (Eigen::Index r = first; r < 3; ++r) *value++ += block(r, c);
  }
}

void NormalMatrix::Linearize(const PoseGraph& graph,
                             std::span<const Pose2> T_map_node,
                             std::span<const double> weights) {
  hessian_.coeffs().setZero();
  gradient_.setZero();
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const PoseEdge& edge = graph.edges[i];
    const EdgeLinearization linear = qwsm::Linearize(edge, T_map_node);
    const Eigen::Matrix3d weighted_from = weights[i] * linear.J_from.transpose() * edge.information;
    const Eigen::Matrix3d weighted_to = weights[i] * linear.J_to.transpose() * edge.information;
    if (edge.from > 0) {
      Add(edge.from, edge.from, weighted_from * linear.J_from);
      gradient_.segment<3>(RowOf(edge.from)) += weighted_from * linear.error;
    }
    if (edge.to > 0) {
      Add(edge.to, edge.to, weighted_to * linear.J_to);
      gradient_.segment<3>(RowOf(edge.to)) += weighted_to * linear.error;
    }
    if (edge.from == 0 || edge.to == 0) continue;
    if (edge.from > edge.to) {
      Add(edge.from, edge.to, weighted_from * linear.J_to);
    } else {
      Add(edge.to, edge.from, weighted_to * linear.J_from);
    }
  }
}

bool NormalMatrix::Factorize() {
  factor_.factorize(hessian_);
  // The factorisation of a singular matrix reports success.
  return factor_.info() == Eigen::Success && (rows() == 0 || factor_.vectorD().minCoeff() > 0.0);
}

}  // namespace qwsm
