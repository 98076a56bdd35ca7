// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "normal_matrix.hpp"

#include <Eigen/OrderingMethods>
#include <algorithm>

namespace qwsm {
namespace {

using Sparse = NormalMatrix::Sparse;

Eigen::Index NodesOf(const PoseGraph& graph) {
  return std::max<Eigen::Index>(0, std::ssize(graph.T_map_node) - 1);
}

// Where each node but the first stands in an order that leaves the factor sparse.
std::vector<Eigen::Index> PlacesOfNodes(const PoseGraph& graph) {
  std::vector<Eigen::Triplet<double>> links;
  for (int node = 0; node < NodesOf(graph); ++node) links.emplace_back(node, node, 1.0);
  for (const PoseEdge& edge : graph.edges) {
    if (edge.from == 0 || edge.to == 0) continue;
    links.emplace_back(static_cast<int>(edge.from - 1), static_cast<int>(edge.to - 1), 1.0);
  }
  Sparse linked(NodesOf(graph), NodesOf(graph));
  linked.setFromTriplets(links.begin(), links.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> node_at_place;
  Eigen::AMDOrdering<int>()(linked, node_at_place);
  std::vector<Eigen::Index> places(static_cast<std::size_t>(NodesOf(graph)));
  for (Eigen::Index place = 0; place < NodesOf(graph); ++place) {
    places[static_cast<std::size_t>(node_at_place.indices()(place))] = place;
  }
  return places;
}

// The places of nodes that an edge links to one, those before it and itself, in order.
std::vector<std::vector<Eigen::Index>> LinksByColumn(const PoseGraph& graph,
                                                     std::span<const Eigen::Index> places) {
  std::vector<std::vector<Eigen::Index>> rows(places.size());
  for (const PoseEdge& edge : graph.edges) {
    if (edge.from == 0 || edge.to == 0) continue;
    const auto [row, column] = std::minmax(places[edge.from - 1], places[edge.to - 1]);
    rows[static_cast<std::size_t>(column)].push_back(row);
  }
  for (std::size_t column = 0; column < rows.size(); ++column) {
    rows[column].push_back(static_cast<Eigen::Index>(column));
    std::ranges::sort(rows[column]);
    const auto repeated = std::ranges::unique(rows[column]);
    rows[column].erase(repeated.begin(), repeated.end());
  }
  return rows;
}

// The upper triangle of a matrix of blocks of three by three, all zero.
Sparse UpperBlocks(std::span<const std::vector<Eigen::Index>> rows_by_column) {
  const Eigen::Index size = 3 * std::ssize(rows_by_column);
  Sparse blocks(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    blocks.startVec(column);
    for (const Eigen::Index row : rows_by_column[static_cast<std::size_t>(column / 3)]) {
      for (Eigen::Index r = 3 * row; r < 3 * row + 3 && r <= column; ++r) {
        blocks.insertBack(r, column) = 0.0;
      }
    }
  }
  blocks.finalize();
  return blocks;
}

}  // namespace

NormalMatrix::NormalMatrix(const PoseGraph& graph)
    : place_of_node_(PlacesOfNodes(graph)),
      hessian_(UpperBlocks(LinksByColumn(graph, place_of_node_))),
      gradient_(hessian_.rows()) {
  factor_.analyzePattern(hessian_);
}

void NormalMatrix::Add(NodeId row, NodeId column, const Eigen::Matrix3d& block) {
  if (RowOf(row) > RowOf(column)) return Add(column, row, block.transpose());
  for (Eigen::Index c = 0; c < 3; ++c) {
    const auto* const begin = hessian_.innerIndexPtr();
    const Eigen::Index sparse_column = RowOf(column) + c;
    const auto* const entry = std::lower_bound(begin + hessian_.outerIndexPtr()[sparse_column],
                                               begin + hessian_.outerIndexPtr()[sparse_column + 1],
                                               RowOf(row));
    double* value = hessian_.valuePtr() + (entry - begin);
    const Eigen::Index last = row == column ? c : 2;
    for (Eigen::Index r = 0; r <= last; ++r) *value++ += block(r, c);
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
    if (edge.from > 0 && edge.to > 0) Add(edge.from, edge.to, weighted_from * linear.J_to);
  }
}

bool NormalMatrix::Factorize() {
  factor_.factorize(hessian_);
  // The factorisation of a singular matrix reports success.
  return factor_.info() == Eigen::Success && (rows() == 0 || factor_.vectorD().minCoeff() > 0.0);
}

}  // namespace qwsm
