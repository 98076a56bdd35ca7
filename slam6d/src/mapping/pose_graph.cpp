// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/mapping/pose_graph.hpp"

#include <algorithm>
#include <cassert>

namespace slam6d {
namespace {

/// Path length from scan `first` to each scan up to `last`, as a share of the whole.
std::vector<double> PathShares(const std::vector<Pose3>& poses,
                               std::size_t first,
                               std::size_t last) {
  // Scans on one spot are told apart by their number.
  constexpr double kLeastStep_m = 1e-3;
  std::vector<double> shares{0.0};
  for (std::size_t scan = first + 1; scan <= last; ++scan) {
    const double step_m = (poses[scan].translation_m - poses[scan - 1].translation_m).norm();
    shares.push_back(shares.back() + step_m + kLeastStep_m);
  }
  const double length_m = shares.back();
  for (double& share : shares) share /= length_m;
  return shares;
}

}  // namespace

std::vector<Pose3> PathLoopCloser::Close(const PoseGraph& graph) const {
  assert(!graph.constraints.empty() && "there is a loop to close");
  std::vector<Pose3> poses = graph.T_map_scan;
  const PoseConstraint& loop = graph.constraints.back();
  const bool forwards = loop.from < loop.to;
  const std::size_t first = forwards ? loop.from : loop.to;
  const std::size_t last = forwards ? loop.to : loop.from;
  const Pose3 T_first_last = forwards ? loop.T_from_to : loop.T_from_to.Inverse();

  const Pose3 closed = poses[first] * T_first_last;
  const Pose3 open = poses[last];
  const Eigen::Vector3d turn_rad =
      RotationVector(NearestRotation(closed.rotation * open.rotation.transpose()));
  const std::vector<double> shares = PathShares(poses, first, last);
  for (std::size_t scan = first + 1; scan <= last; ++scan) {
    const Eigen::Matrix3d turn = RotationFromVector(shares[scan - first] * turn_rad);
    const Pose3& before = graph.T_map_scan[scan - 1];
    poses[scan].rotation = turn * poses[scan].rotation;
    poses[scan].translation_m =
        poses[scan - 1].translation_m + turn * (poses[scan].translation_m - before.translation_m);
  }
  const Eigen::Vector3d move_m = closed.translation_m - poses[last].translation_m;
  for (std::size_t scan = first + 1; scan <= last; ++scan) {
    poses[scan].translation_m += shares[scan - first] * move_m;
  }
  for (std::size_t scan = last + 1; scan < poses.size(); ++scan) {
    poses[scan] = closed * open.Inverse() * poses[scan];
  }
  return poses;
}

}  // namespace slam6d
