// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "qwsm/graph/graph_solver.hpp"

namespace qwsm {

/// How uncertain the poses of a solved graph are, the first being certain: the inverse of the
/// normal equations' matrix, of which only what is asked for is computed.
class GraphCovariance {
 public:
  /// @pre `solution` is of `graph`. Complexity: one sparse factorisation.
  GraphCovariance(const PoseGraph& graph, const GraphSolution& solution);
  ~GraphCovariance();
  GraphCovariance(GraphCovariance&&) noexcept;
  GraphCovariance& operator=(GraphCovariance&&) noexcept;

  /// Marginal covariances of all nodes, of (x, y, theta) in the map's frame, by the recursion of
  /// Takahashi et al. (1973) on the pattern of the factor.
  std::vector<Eigen::Matrix3d> Marginals() const;

  /// Covariances of T_from_node for the nodes, the translation along the axes of `from`: how
  /// uncertain each is as seen from one. Complexity: three solves beside the marginals.
  /// @param marginals as Marginals() returns them.
  std::vector<Eigen::Matrix3d> RelativeTo(NodeId from,
                                          std::span<const NodeId> nodes,
                                          const std::vector<Eigen::Matrix3d>& marginals) const;

 private:
  struct Factor;

  std::vector<Pose2> T_map_node_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace qwsm
