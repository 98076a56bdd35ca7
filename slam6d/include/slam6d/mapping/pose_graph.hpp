// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "slam6d/geometry/pose3.hpp"

namespace slam6d {

/// The relative pose of two scans of a graph, found by registration.
struct PoseConstraint {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose3 T_from_to;
  /// Covariance of the relative pose as in UncertainPose3.
  Matrix6d covariance = Matrix6d::Identity();
};

/// Scans and what is known of their relative poses.
struct PoseGraph {
  std::vector<Pose3> T_map_scan;
  /// The constraint that closed a loop last stands last.
  std::vector<PoseConstraint> constraints;
};

/// Spreads the error of a loop over its scans (Nüchter et al. 2007, section 3.4). The first scan
/// stays where it is.
class LoopCloser {
 public:
  LoopCloser() = default;
  LoopCloser(const LoopCloser&) = delete;
  LoopCloser& operator=(const LoopCloser&) = delete;
  virtual ~LoopCloser() = default;

  /// Poses that agree with the constraints as well as this method makes them.
  /// @pre the graph has a constraint, and every scan hangs on the first by constraints.
  virtual std::vector<Pose3> Close(const PoseGraph& graph) const = 0;
};

/// Gives every scan of the last loop a share of its error in proportion to the path up to it: first
/// of the rotation, which bends the path, then of what is still missing of the translation. What
/// comes after the loop moves as a whole.
class PathLoopCloser final : public LoopCloser {
 public:
  std::vector<Pose3> Close(const PoseGraph& graph) const override;
};

}  // namespace slam6d
