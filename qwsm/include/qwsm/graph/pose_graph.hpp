// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "qwsm/geometry/pose2.hpp"

namespace qwsm {

/// Index of a node in its graph.
using NodeId = std::uint32_t;

/// Whether an edge is believed.
enum class EdgeTrust : std::uint8_t {
  kBackbone,  ///< Odometry, and matches with the scans just before: always believed.
  kLoop,      ///< A place that was recognised: believed as far as the other edges agree with it.
};

/// What a match or odometry tells of the pose of one node as seen from another.
struct PoseEdge {
  NodeId from = 0;
  NodeId to = 0;
  Pose2 T_from_to;
  /// Inverse covariance of (x, y, theta), the translation along the axes of `from`. It is zero
  /// in a direction of which the edge tells nothing, such as along a corridor.
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  EdgeTrust trust = EdgeTrust::kBackbone;
};

/// The pose of `to` as seen from `from`, as uncertain as the edge tells. Of a direction of which it
/// tells nothing the sigma is a kilometre.
UncertainPose2 MeasuredBy(const PoseEdge& edge);

/// Poses in one frame `map`, and what is known of them relative to each other.
struct PoseGraph {
  std::vector<Pose2> T_map_node;
  std::vector<PoseEdge> edges;
};

/// The error of an edge to first order around the poses of its nodes: e + J_from d_from + J_to d_to
/// for steps d of (x, y, theta) in the map's frame.
struct EdgeLinearization {
  Eigen::Vector3d error;  ///< (x, y) along the axes of `from`, and theta.
  Eigen::Matrix3d J_from;
  Eigen::Matrix3d J_to;
};
EdgeLinearization Linearize(const PoseEdge& edge, std::span<const Pose2> T_map_node);

/// Squared Mahalanobis distance of the poses from what the edge tells, e^T Omega e: chi-square
/// distributed with three degrees of freedom where the edge is right and tells of all three.
double Chi2(const PoseEdge& edge, std::span<const Pose2> T_map_node);

}  // namespace qwsm
