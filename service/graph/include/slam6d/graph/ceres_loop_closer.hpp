// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/mapping/pose_graph.hpp"

namespace slam6d::graph {

/// Poses that agree best with all constraints, each weighted by its covariance; constraints that
/// contradict the others lose their weight (Huber). Non-linear least squares by Ceres.
class CeresLoopCloser final : public LoopCloser {
 public:
  std::vector<Pose3> Close(const PoseGraph& graph) const override;
};

}  // namespace slam6d::graph
