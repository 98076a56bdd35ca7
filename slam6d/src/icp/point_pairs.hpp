// SPDX-FileCopyrightText: 2026 the Q-WSM developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/src/icp/icp_minimizer.hpp"

namespace slam6d {

/// Sums over pairs of points.
struct PointSums {
  PairMoments moments;
  double distance2_m2 = 0.0;  ///< Sum of the squared distances.

  PointSums In(const Pose3& T_map_ref) const;
  PointSums& operator+=(const PointSums& other);
};

/// Point to point: nearest points, closed form (Nüchter et al. 2007, Eqs. 2-6).
class PointPairs {
 public:
  using Sums = PointSums;

  /// Pairs two scans, which must outlive this.
  PointPairs(const ScanModel& ref, const ScanModel& cur, const IcpOptions& options);

  Sums Collect(const Pose3& T_ref_cur, int iteration);
  /// Information on the pose, in the frame ref, for residuals of one metre; from the pairs
  /// collected last.
  Matrix6d Curvature() const;
  Matrix6d Weight() const { return Curvature(); }
  const SearchStatistics& statistics() const { return statistics_; }

  static IcpStep Step(const Sums& sums, const PoseAndGuess& T_map, const IcpOptions& options);
  static Matrix6d Told(const Sums& sums, const Matrix6d& curvature, const UncertainPose3& guess);
  static Matrix6d ToldByGuess(const UncertainPose3&) { return Matrix6d::Zero(); }

 private:
  const PointCloud& cur_;
  const IcpOptions options_;
  CachedSearch search_;
  SimdLevel simd_;
  Pose3 T_ref_cur_;  ///< Where pairs were collected last.
  Eigen::Vector3d origin_m_;
  double counted_distance2_m2_;  ///< Pairs as far apart as this do not count.
  double rms_residual_m_ = 0.0;
  SearchStatistics statistics_;
};

}  // namespace slam6d
