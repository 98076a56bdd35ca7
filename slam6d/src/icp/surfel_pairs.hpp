// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/src/icp/icp_minimizer.hpp"
#include "slam6d/src/icp/observable_motions.hpp"

namespace slam6d {

/// The normal equations of one Gauss-Newton step over (x, y, z, roll, pitch, yaw).
struct NormalEquations {
  Matrix6d A = Matrix6d::Zero();
  /// How fast b really changes with the pose: A but for the weights, which give way as residuals
  /// grow. The pose is as uncertain as this says (the sandwich of Huber 1967).
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d b = Vector6d::Zero();
  /// What the errors of the normals alone add to A and b, on average.
  Matrix6d A_noise = Matrix6d::Zero();
  Vector6d b_noise = Vector6d::Zero();
  double weighted_residual2 = 0.0;  ///< Squared residuals over their variances.
  double residual2_m2 = 0.0;
  std::size_t pairs = 0;
  /// The same by clusters of the current scan's surfels.
  std::vector<ClusterEquations> clusters{};
  bool settled = true;  ///< Whether the scale of the residuals has its final value.

  NormalEquations In(const Pose3& T_map_ref) const;
  NormalEquations& operator+=(const NormalEquations& other);
};

/// Point to plane and plane to plane: Gauss-Newton on distances along surface normals.
class SurfelPairs {
 public:
  using Sums = NormalEquations;

  /// Pairs two scans, which must outlive this.
  SurfelPairs(const ScanModel& ref, const ScanModel& cur, const IcpOptions& options);

  Sums Collect(const Pose3& T_ref_cur, int iteration);
  /// How fast the gradient changes with the pose, in the frame ref, from the pairs collected last.
  const Matrix6d& Curvature() const { return curvature_; }
  /// The same, but for the weights that give way as residuals grow: never negative.
  const Matrix6d& Weight() const { return weight_; }
  const SearchStatistics& statistics() const { return statistics_; }

  static IcpStep Step(const Sums& sums, const PoseAndGuess& T_map, const IcpOptions& options);
  static Matrix6d Told(const Sums& sums, const Matrix6d& curvature, const UncertainPose3& guess);
  /// For what the pairs leave open.
  static Matrix6d ToldByGuess(const UncertainPose3& guess);

 private:
  /// Weights and normals of an iteration.
  struct Rules {
    Pose3 T_ref_cur;
    double scale2_m2;  ///< Residuals well above this lose their weight.
  };

  bool ShrinkScale();
  NormalEquations Sum(const Rules& rules, std::size_t first, std::size_t last);
  NormalEquations SumClusters(const Rules& rules, std::size_t first, std::size_t last);
  void AddPair(const Rules& rules, std::size_t i, NormalEquations& equations);

  const SurfelMap& ref_;
  const SurfelMap* cur_surfels_;  ///< Null for points.
  const IcpOptions options_;
  PointCloud cur_;
  CachedSearch search_;
  /// Residuals of the current points in the last iteration, or NaN.
  std::vector<double> residuals_m_;
  double scale_m_;  ///< Residuals well above this lose their weight.
  Matrix6d curvature_ = Matrix6d::Zero();
  Matrix6d weight_ = Matrix6d::Zero();
  SearchStatistics statistics_;
};

}  // namespace slam6d
